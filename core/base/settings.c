/* Settings by name, their defaults and checks, and their values as numbers, all by the table of settings-table.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "celdepth/settings.h"

#include <string.h>

const CeldSettingInfo *
celd_setting_find (const char *name)
{
  size_t                 n;
  const CeldSettingInfo *info = celd_setting_infos (&n);

  for (size_t i = 0; i < n; i++)
    if (!strcmp (info[i].name, name))
      return &info[i];
  return NULL;
}

double
celd_setting_get (const CeldSettingInfo *info, const void *record)
{
  const void    *member = (const char *) record + info->offset;
  const uint8_t *colour = member;

  switch (info->type)
    {
    case CELD_SETTING_NUMBER:  return (double) *(const float *) member;
    case CELD_SETTING_INTEGER:
    case CELD_SETTING_CHOICE:  return *(const int *) member; /* enumerations are as large as int */
    case CELD_SETTING_SWITCH:  return *(const bool *) member;
    case CELD_SETTING_COLOUR:  return colour[0] * 65536 + colour[1] * 256 + colour[2];
    case CELD_SETTING_TEXT:    break;
    }
  return 0;
}

void
celd_setting_set (const CeldSettingInfo *info, double value, void *record)
{
  void    *member = (char *) record + info->offset;
  uint8_t *colour = member;

  switch (info->type)
    {
    case CELD_SETTING_NUMBER:
      *(float *) member = (float) value;
      break;
    case CELD_SETTING_INTEGER:
    case CELD_SETTING_CHOICE:
      *(int *) member = (int) value;
      break;
    case CELD_SETTING_SWITCH:
      *(bool *) member = value != 0;
      break;
    case CELD_SETTING_COLOUR:
      for (int c = 0; c < 3; c++)
        colour[c] = (uint8_t) ((uint32_t) value >> (16 - 8 * c));
      break;
    case CELD_SETTING_TEXT:
      break;
    }
}

/* Numbers are compared as floats: 0.99f is above 0.99. */
bool
celd_setting_allows (const CeldSettingInfo *info, double value)
{
  if (info->type == CELD_SETTING_NUMBER)
    return (float) value >= (float) info->least && (float) value <= (float) info->most;
  return value >= info->least && value <= info->most;
}

CeldSettings
celd_settings (void)
{
  CeldSettings           settings = { 0 };
  size_t                 n;
  const CeldSettingInfo *info = celd_setting_infos (&n);

  for (size_t i = 0; i < n; i++)
    celd_setting_set (&info[i], info[i].usual, &settings);
  return settings;
}

CeldStatus
celd_settings_check (const CeldSettings *settings)
{
  size_t                 n;
  const CeldSettingInfo *info = celd_setting_infos (&n);

  for (size_t i = 0; i < n; i++)
    if (!celd_setting_allows (&info[i], celd_setting_get (&info[i], settings)))
      return CELD_BAD_VALUE;
  if (settings->encoding == CELD_ENCODING_FIXED && settings->near_level <= settings->far_level)
    return CELD_BAD_VALUE;
  return CELD_OK;
}
