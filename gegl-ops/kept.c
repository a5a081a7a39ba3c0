/* A result that an operation keeps between calls, for as long as all that it was made of stays the same.
 *
 * Input is compared by a fingerprint of 64 bits.  One word that differs always changes it, and so do several, but for
 * once in 2^64.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op.h"

#include <string.h>

#define FACTOR G_GUINT64_CONSTANT (0x9e3779b97f4a7c15) /* odd; 2^64 by the golden ratio */

guint64
celd_op_add_input (guint64 fingerprint, const void *data, gsize size)
{
  const char *bytes = data;
  guint64     word;

  size        = data ? size : 0;
  fingerprint = (fingerprint ^ size) * FACTOR;
  for (gsize at = 0; at + sizeof word <= size; at += sizeof word)
    {
      memcpy (&word, bytes + at, sizeof word);
      fingerprint  = (fingerprint ^ word) * FACTOR;
      fingerprint ^= fingerprint >> 32;
    }
  word = 0;
  if (size % sizeof word)
    memcpy (&word, bytes + size - size % sizeof word, size % sizeof word);
  return (fingerprint ^ word) * FACTOR;
}

guint64
celd_op_add_text (guint64 fingerprint, const char *text)
{
  return celd_op_add_input (fingerprint, text, text ? strlen (text) : 0);
}

guint64
celd_op_settings_input (CeldOp *op)
{
  size_t                 n;
  const CeldSettingInfo *info = celd_setting_infos (&n);
  guint64                fingerprint = celd_op_add_input (1, &op->picture, sizeof op->picture);

  for (size_t i = 0; i < n; i++)
    {
      double value = celd_setting_get (&info[i], &op->settings);

      fingerprint = celd_op_add_input (fingerprint, &value, sizeof value);
    }
  return fingerprint;
}

gpointer
celd_op_kept (CeldOp *op, guint64 input)
{
  CeldKept *kept = &op->operation->kept;

  if (kept->result && kept->input != input)
    {
      kept->destroy (kept->result);
      kept->result = NULL;
    }
  return kept->result;
}

void
celd_op_keep (CeldOp *op, guint64 input, gpointer result, GDestroyNotify destroy)
{
  op->operation->kept = (CeldKept) { result, destroy, input };
}
