/* Statuses, problems and contradictions as English sentences for artists.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

const char *
celd_status_text (CeldStatus status)
{
  switch (status)
    {
    case CELD_OK:               return "Done.";
    case CELD_CANCELLED:        return "Cancelled.";
    case CELD_NO_MEMORY:        return "Not enough memory for a picture of this size.";
    case CELD_BAD_SIZE:         return "The layers must have the size of the drawing, 1 to 20000 pixels a side.";
    case CELD_BAD_VALUE:        return "A setting is outside its range, or the near level is not above the far level.";
    case CELD_BAD_RELATION:     return "The relations cannot be read.";
    case CELD_NOTHING_TO_GO_BY: return "There is nothing to go by: scribble over the parts of the drawing, or draw an "
                                       "arrow from a nearer to a farther part.";
    }
  return "Unknown status.";
}

void
celd_label_name (const CeldPalette *palette, uint32_t label, char *name, size_t size)
{
  const uint8_t *c = palette->item[label - 1].colour;
  size_t         alike = 0;

  for (size_t i = 0; i < palette->n; i++)
    alike += !memcmp (palette->item[i].colour, c, sizeof palette->item[i].colour);
  if (!c[3])
    snprintf (name, size, "background");
  else if (alike > 1)
    snprintf (name, size, "#%02x%02x%02x label %u", c[0], c[1], c[2], (unsigned) label);
  else
    snprintf (name, size, "#%02x%02x%02x", c[0], c[1], c[2]);
}

/* " #rrggbb" of a label, " the background", or nothing if it is not known, or if nobody painted its colour. */
static const char *
label_name (const CeldPalette *palette, uint32_t label, char name[24])
{
  name[0] = 0;
  if (palette && label >= 1 && label <= palette->n && palette->item[label - 1].origin != CELD_FROM_ARROW)
    {
      const uint8_t *c = palette->item[label - 1].colour;

      if (c[3])
        snprintf (name, 24, " #%02x%02x%02x", c[0], c[1], c[2]);
      else
        snprintf (name, 24, " the background");
    }
  return name;
}

/* "the relation in line 3, column 7" or "the arrow from (x, y) to (x, y)". */
static void
relation_name (const CeldRelations *relations, size_t index, char *name, size_t size)
{
  const CeldRelation *r = relations && index < relations->n ? &relations->item[index] : NULL;

  if (r && r->source == CELD_SOURCE_TEXT && r->id)
    snprintf (name, size, "relation %u", (unsigned) r->id);
  else if (r && r->source == CELD_SOURCE_PATH)
    snprintf (name, size, "the arrow in line %d, column %d of the path", r->line, r->column);
  else if (r && r->source == CELD_SOURCE_TEXT)
    snprintf (name, size, "the relation in line %d, column %d", r->line, r->column);
  else if (r)
    snprintf (name, size, "the arrow from (%.0f, %.0f) to (%.0f, %.0f)", r->nearer.x, r->nearer.y, r->farther.x,
              r->farther.y);
  else
    snprintf (name, size, "a relation");
}

void
celd_problem_text (const CeldProblem *p, const CeldPalette *palette, const CeldRelations *relations, char *text,
                   size_t size)
{
  char label[24], other[24], relation[96];

  label_name (palette, p->label, label);
  label_name (palette, p->other, other);
  relation_name (relations, p->relation, relation, sizeof relation);
  relation[0] = (char) toupper ((unsigned char) relation[0]);
  switch (p->kind)
    {
    case CELD_PROBLEM_STROKE_OVERRULED:
      snprintf (text, size, "The stroke%s at (%d, %d) was overruled: most of it went to%s. Paint more of it there, "
                "close the contour between the two, or use hard strokes.",
                label, p->x, p->y, other[0] ? other : " another colour");
      break;
    case CELD_PROBLEM_REGION_UNREACHED:
      snprintf (text, size, "No stroke reaches the region at (%d, %d); it was given to%s. Put a stroke "
                "into it if that is wrong.",
                p->x, p->y, label[0] ? label : " a neighbour");
      break;
    case CELD_PROBLEM_COLOUR_LOST:
      snprintf (text, size, "The colour%s, painted at (%d, %d), has no region left. Paint more of it, or use "
                "hard strokes.",
                label, p->x, p->y);
      break;
    case CELD_PROBLEM_ARROW_UNCLEAR:
      snprintf (text, size, "The arrow at (%d, %d) does not say which end is nearer, so it was left out. Draw it "
                "again with a clearer head, or check the arrow style.",
                p->x, p->y);
      break;
    case CELD_PROBLEM_OUTSIDE:
      snprintf (text, size, "%s names a point outside the drawing, so it was left out.", relation);
      break;
    case CELD_PROBLEM_UNKNOWN_COLOUR:
      snprintf (text, size, "%s names a colour that no region has, so it was left out. Use the colour of a "
                "scribble.",
                relation);
      break;
    case CELD_PROBLEM_SAME_REGION:
      snprintf (text, size, "%s has both ends in the region%s, so it was left out. Scribble another colour at "
                "one of its ends.",
                relation, label);
      break;
    case CELD_PROBLEM_CONTRADICTION:
      snprintf (text, size, "%s contradicts the others, so it was left out. Turn it round, or delete another one "
                "of the circle.",
                relation);
      break;
    case CELD_PROBLEM_NOT_CONVERGED:
      snprintf (text, size, "Smooth depth is less exact than asked for. Allow a larger tolerance if this does "
                "not matter.");
      break;
    case CELD_PROBLEM_REGION_SPLIT:
      snprintf (text, size, "Relations go round in a circle, so the region%s was split: its part at (%d, %d) has a "
                "level of its own, and the sheet bends. Delete a relation of the circle if that is wrong.",
                label, p->x, p->y);
      break;
    case CELD_PROBLEM_HIDDEN_UNSURE:
      snprintf (text, size, "It is unsure how the region%s goes on behind others at (%d, %d). If the guess is wrong, "
                "paint what is hidden of it, in its colour, on a layer named Hidden.",
                label, p->x, p->y);
      break;
    }
}

void
celd_cycle_text (const CeldCycle *cycle, const CeldRelations *relations, char *text, size_t size)
{
  char   relation[96];
  size_t used = (size_t) snprintf (text, size, "It goes round in a circle with ");

  for (size_t i = 1; i < cycle->n && used < size; i++)
    {
      relation_name (relations, cycle->item[i], relation, sizeof relation);
      used += (size_t) snprintf (text + used, size - used, "%s%s", relation, i + 1 < cycle->n ? ", " : ".");
    }
  if (cycle->label && used < size)
    snprintf (text + used, size - used, " That is so because #%02x%02x%02x has one depth at (%d, %d) and at (%d, %d); "
              "the setting 'Same colour: Separate depths' gives each its own.", cycle->colour[0], cycle->colour[1],
              cycle->colour[2], cycle->x[0], cycle->y[0], cycle->x[1], cycle->y[1]);
}
