/* Statuses, problems and contradictions as sentences for artists, in English or as a host translates them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

#include <stdio.h>
#include <string.h>

const char *
celd_in (CeldTranslate translate, const char *text)
{
  return translate ? translate (text) : text;
}

const char *
celd_status_text (CeldStatus status)
{
  switch (status)
    {
    case CELD_OK:               return N_ ("Done.");
    case CELD_CANCELLED:        return N_ ("Cancelled.");
    case CELD_NO_MEMORY:        return N_ ("Not enough memory for a picture of this size.");
    case CELD_BAD_SIZE:         return N_ ("The layers must have the size of the drawing, 1 to 20000 pixels a side.");
    case CELD_BAD_VALUE:        return N_ ("A setting is outside its range, or the near level is not above the far "
                                           "level.");
    case CELD_BAD_RELATION:     return N_ ("The relations cannot be read.");
    case CELD_NOTHING_TO_GO_BY: return N_ ("There are no scribbles and no arrows: scribble over the parts of the drawing, "
                                           "or draw an arrow from a nearer to a farther part.");
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
    snprintf (name, size, N_ ("background"));
  else if (alike > 1)
    snprintf (name, size, "#%02x%02x%02x label %u", c[0], c[1], c[2], (unsigned) label);
  else
    snprintf (name, size, "#%02x%02x%02x", c[0], c[1], c[2]);
}

/* ------------------------------------------------------------------ names */

/* The colour of a label after the name of a thing, " #rrggbb" or " of the background"; "" if it is not known, or if
 * nobody painted it. */
static const char *
colour_after (const CeldPalette *palette, uint32_t label, CeldTranslate translate, char name[48])
{
  name[0] = 0;
  if (palette && label >= 1 && label <= palette->n && palette->item[label - 1].origin != CELD_FROM_ARROW)
    {
      const uint8_t *c = palette->item[label - 1].colour;

      if (c[3])
        snprintf (name, 48, " #%02x%02x%02x", c[0], c[1], c[2]);
      else
        snprintf (name, 48, " %s", celd_in (translate, N_ ("of the background")));
    }
  return name;
}

/* To whom something was given: "#rrggbb", "the background", or, if that is not known, `other`. */
static const char *
receiver (const CeldPalette *palette, uint32_t label, const char *other, CeldTranslate translate, char name[48])
{
  const char *colour = colour_after (palette, label, NULL, name);

  if (!colour[0])
    return celd_in (translate, other);
  return palette->item[label - 1].colour[3] ? colour + 1 : celd_in (translate, N_ ("the background"));
}

/* "the relation in line 3, column 7" or "the arrow from (x, y) to (x, y)", also for the beginning of a sentence. */
static void
relation_name (const CeldRelations *relations, size_t index, bool begins, CeldTranslate translate, char *name,
               size_t size)
{
  const CeldRelation *r = relations && index < relations->n ? &relations->item[index] : NULL;

  if (r && r->source == CELD_SOURCE_TEXT && r->id)
    snprintf (name, size, celd_in (translate, begins ? N_ ("Relation %u") : N_ ("relation %u")), (unsigned) r->id);
  else if (r && r->source == CELD_SOURCE_PATH)
    snprintf (name, size, celd_in (translate, begins ? N_ ("The arrow in line %d, column %d of the path")
                                                          : N_ ("the arrow in line %d, column %d of the path")),
              r->line, r->column);
  else if (r && r->source == CELD_SOURCE_TEXT)
    snprintf (name, size, celd_in (translate, begins ? N_ ("The relation in line %d, column %d")
                                                          : N_ ("the relation in line %d, column %d")),
              r->line, r->column);
  else if (r)
    snprintf (name, size, celd_in (translate, begins ? N_ ("The arrow from (%.0f, %.0f) to (%.0f, %.0f)")
                                                          : N_ ("the arrow from (%.0f, %.0f) to (%.0f, %.0f)")),
              r->nearer.x, r->nearer.y, r->farther.x, r->farther.y);
  else
    snprintf (name, size, "%s", celd_in (translate, begins ? N_ ("A relation") : N_ ("a relation")));
}

/* ------------------------------------------------------------------ sentences */

/* About a painted arrow that was left out, with places for x and y. */
static const char *
arrow_text (CeldArrowReason reason)
{
  switch (reason)
    {
    case CELD_REASON_SHORT:
      return N_ ("The arrow at (%d, %d) is too short for its width, so it was left out. Draw it longer, or with a "
                 "thinner brush.");
    case CELD_REASON_HEAD:
      return N_ ("The arrow at (%d, %d) has a head that does not agree with its opacity or width, so it was left out. "
                 "Draw it without a head, or choose the arrow style for heads.");
    case CELD_REASON_UNEVEN:
      return N_ ("The arrow at (%d, %d) turns sharply, changes its colour, or does not get fainter or thinner all the "
                 "way: it may be two that touch, so it was left out. Draw it again in one go, or draw two apart from "
                 "each other.");
    case CELD_REASON_MEETING:
      return N_ ("The arrow at (%d, %d) meets other strokes, and which way it goes on there is not clear, so it was "
                 "left out. Draw it apart from them, or in another colour.");
    case CELD_REASON_PIECE:
      return N_ ("The small stroke at (%d, %d) may be a piece of the one next to it, so it was left out. Draw arrows "
                 "without gaps, and farther from each other.");
    case CELD_REASON_HIDDEN:
      return N_ ("The arrow at (%d, %d) may have an end below other strokes, so it was left out. Draw its ends where "
                 "they can be seen.");
    case CELD_REASON_FRAME:
      return N_ ("The arrow at (%d, %d) may go on beyond the edge of the picture, so it was left out. Draw it farther "
                 "inside.");
    default:
      return N_ ("The arrow at (%d, %d) does not say which end is nearer, so it was left out. Draw it again with a "
                 "clearer head, or check the arrow style.");
    }
}

/* About a relation that was left out. */
static void
left_out_text (const CeldProblem *p, const CeldPalette *palette, const CeldRelations *relations,
               CeldTranslate translate, char *text, size_t size)
{
  char colour[48], relation[160];

  relation_name (relations, p->relation, true, translate, relation, sizeof relation);
  if (p->kind == CELD_PROBLEM_OUTSIDE)
    snprintf (text, size, celd_in (translate, N_ ("%s names a point outside the drawing, so it was left out.")),
              relation);
  else if (p->kind == CELD_PROBLEM_UNKNOWN_COLOUR && p->relation == CELD_NO_INDEX)
    snprintf (text, size, celd_in (translate, N_ ("No region has the colour of the background, so there is none. The "
                                                  "nearest colour is %s.")),
              receiver (palette, p->label, N_ ("not known"), translate, colour));
  else if (p->kind == CELD_PROBLEM_UNKNOWN_COLOUR && p->label && palette)
    snprintf (text, size, celd_in (translate, N_ ("%s names a colour that no region has, so it was left out. The "
                                                  "nearest colour is %s.")),
              relation, receiver (palette, p->label, N_ ("not known"), translate, colour));
  else if (p->kind == CELD_PROBLEM_UNKNOWN_COLOUR)
    snprintf (text, size, celd_in (translate, N_ ("%s names a colour that no region has, so it was left out. Use the "
                                                  "colour of a scribble.")), relation);
  else if (p->kind == CELD_PROBLEM_SAME_REGION)
    snprintf (text, size, celd_in (translate, N_ ("%s has both ends in the region%s, so it was left out. Scribble "
                                                  "another colour at one of its ends.")),
              relation, colour_after (palette, p->label, translate, colour));
  else
    snprintf (text, size, celd_in (translate, N_ ("%s contradicts the others, so it was left out. Turn it round, or "
                                                  "delete another one of the circle.")), relation);
}

void
celd_problem_text (const CeldProblem *p, const CeldPalette *palette, const CeldRelations *relations,
                   CeldTranslate translate, char *text, size_t size)
{
  char        name[48], other[48];
  const char *colour = colour_after (palette, p->label, translate, name);

  switch (p->kind)
    {
    case CELD_PROBLEM_STROKE_OVERRULED:
      snprintf (text, size, celd_in (translate, N_ ("The stroke%s at (%d, %d) was overruled: most of it went to %s. "
                                                    "Paint more of it there, close the contour between the two, or "
                                                    "increase the hardness.")),
                colour, p->x, p->y, receiver (palette, p->other, N_ ("another colour"), translate, other));
      break;
    case CELD_PROBLEM_REGION_UNREACHED:
      snprintf (text, size, celd_in (translate, N_ ("No stroke reaches the region at (%d, %d); it was given to %s. Put "
                                                    "a stroke into it if that is wrong.")),
                p->x, p->y, receiver (palette, p->label, N_ ("a neighbour"), translate, other));
      break;
    case CELD_PROBLEM_COLOUR_LOST:
      snprintf (text, size, celd_in (translate, N_ ("The colour%s, painted at (%d, %d), has no region left. Paint more "
                                                    "of it, or increase the hardness.")),
                colour, p->x, p->y);
      break;
    case CELD_PROBLEM_ARROW_UNCLEAR:
      snprintf (text, size, celd_in (translate, arrow_text (p->reason)), p->x, p->y);
      break;
    case CELD_PROBLEM_OUTSIDE:
    case CELD_PROBLEM_UNKNOWN_COLOUR:
    case CELD_PROBLEM_SAME_REGION:
    case CELD_PROBLEM_CONTRADICTION:
      left_out_text (p, palette, relations, translate, text, size);
      break;
    case CELD_PROBLEM_NOT_CONVERGED:
      snprintf (text, size, "%s", celd_in (translate, N_ ("Smooth depth is less exact than asked for. Allow a larger "
                                                          "tolerance if this does not matter.")));
      break;
    case CELD_PROBLEM_REGION_SPLIT:
      snprintf (text, size, celd_in (translate, N_ ("Relations go round in a circle, so the region%s was split: its "
                                                    "part at (%d, %d) has a level of its own, and the sheet bends. "
                                                    "Delete a relation of the circle if that is wrong.")),
                colour, p->x, p->y);
      break;
    case CELD_PROBLEM_HIDDEN_UNSURE:
      snprintf (text, size, celd_in (translate, N_ ("It is unsure how the region%s goes on behind others at (%d, %d). "
                                                    "If the guess is wrong, paint what is hidden of it, in its "
                                                    "colour, on a layer named Hidden.")),
                colour, p->x, p->y);
      break;
    case CELD_PROBLEM_STROKE_FAINT:
      snprintf (text, size, celd_in (translate, N_ ("The stroke at (%d, %d) is so faint that it was left out. Paint it "
                                                    "again with a brush that is more opaque, or erase it.")),
                p->x, p->y);
      break;
    case CELD_PROBLEM_STROKE_UNMATCHED:
      snprintf (text, size, celd_in (translate, N_ ("The stroke at (%d, %d) changes nothing, because hardly anything "
                                                    "on its layer has the colour of a region. Paint corrections and "
                                                    "hidden parts in the colours of the scribbles.")),
                p->x, p->y);
      break;
    }
}

void
celd_cycle_text (const CeldCycle *cycle, const CeldRelations *relations, CeldTranslate translate, char *text,
                 size_t size)
{
  char   relation[160], list[600] = "";
  size_t used = 0;

  for (size_t i = 1; i < cycle->n && used < sizeof list; i++)
    {
      relation_name (relations, cycle->item[i], false, translate, relation, sizeof relation);
      used += (size_t) snprintf (list + used, sizeof list - used, "%s%s", relation, i + 1 < cycle->n ? ", " : "");
    }
  used = (size_t) snprintf (text, size, celd_in (translate, N_ ("It goes round in a circle with %s.")), list);
  if (cycle->label && used + 1 < size)
    {
      text[used++] = ' ';
      snprintf (text + used, size - used,
                celd_in (translate, N_ ("That is so because #%02x%02x%02x has one depth at (%d, %d) and at (%d, %d); "
                                        "the setting 'Same colour: Separate depths' gives each its own.")),
                cycle->colour[0], cycle->colour[1], cycle->colour[2], cycle->x[0], cycle->y[0], cycle->x[1],
                cycle->y[1]);
    }
}
