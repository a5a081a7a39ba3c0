/* The page of the operations' tests as input of the pipeline of the plug-ins.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef PIPELINE_PAGE_H
#define PIPELINE_PAGE_H

#include "page.h"
#include "pipeline-parts.h"

#define BIT(picture) (1u << CELD_PICTURE_##picture)

static inline CeldPipelineInput
page_input (void)
{
  CeldPipelineInput input = { WIDTH, HEIGHT, { { NULL, 0, 0, 0 } }, celd_settings (), NULL, NULL };

  input.layer[CELD_LAYER_DRAWING].buffer   = drawing;
  input.layer[CELD_LAYER_SCRIBBLES].buffer = scribbles;
  input.layer[CELD_LAYER_ARROWS].buffer    = arrows;
  return input;
}

#endif
