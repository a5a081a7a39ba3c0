// Reads XML by the parser of GLib, which knows no entities but those of characters, so that no text grows.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "xml.hpp"

#include "celdepth-io.hpp"

#include <glib.h>

#include <cmath>
#include <cstring>

constexpr size_t most_depth = 100;                // of nested elements, which other code visits recursively (chosen)
constexpr double most_exact = 9007199254740992.0; // 2^53: larger numbers are not exact

std::string
XmlElement::text (const std::string &attribute, const std::string &usual) const
{
  const auto found = attributes.find (attribute);

  return found == attributes.end () ? usual : found->second;
}

double
XmlElement::number (const std::string &attribute, double usual) const
{
  const std::string value = text (attribute);
  char             *end;
  const double      number = g_ascii_strtod (value.c_str (), &end);

  return end == value.c_str () || *end || !(std::abs (number) <= most_exact) ? usual : number;
}

const XmlElement *
XmlElement::child (const std::string &child_name) const
{
  for (const XmlElement &element : children)
    if (element.name == child_name)
      return &element;
  return nullptr;
}

// The elements that are open, the innermost last.
using OpenElements = std::vector<XmlElement>;

// Exceptions must not pass through the parser, which is C.
static void
begin (GMarkupParseContext *, const char *name, const char **names, const char **values, void *data, GError **error)
{
  OpenElements &open = *static_cast<OpenElements *> (data);
  std::string   why;

  if (open.size () > most_depth)
    g_set_error_literal (error, G_MARKUP_ERROR, G_MARKUP_ERROR_INVALID_CONTENT, "it is nested too deep");
  else if (!succeeds (why, [&] {
             open.push_back ({ name, {}, {} });
             for (size_t i = 0; names[i]; i++)
               open.back ().attributes[names[i]] = values[i];
           }))
    g_set_error_literal (error, G_MARKUP_ERROR, G_MARKUP_ERROR_INVALID_CONTENT, why.c_str ());
}

static void
end (GMarkupParseContext *, const char *, void *data, GError **error)
{
  OpenElements &open = *static_cast<OpenElements *> (data);
  std::string   why;

  if (!succeeds (why, [&] {
        XmlElement element = std::move (open.back ());

        open.pop_back ();
        open.back ().children.push_back (std::move (element));
      }))
    g_set_error_literal (error, G_MARKUP_ERROR, G_MARKUP_ERROR_INVALID_CONTENT, why.c_str ());
}

XmlElement
parse_xml (const std::string &text, const std::string &file)
{
  const GMarkupParser  parser = { begin, end, nullptr, nullptr, nullptr };
  OpenElements         open (1); // the document, whose only child is the root
  GMarkupParseContext *context = g_markup_parse_context_new (&parser, GMarkupParseFlags (0), &open, nullptr);
  GError              *error   = nullptr;
  const bool           good    = g_markup_parse_context_parse (context, text.data (), gssize (text.size ()), &error) &&
                    g_markup_parse_context_end_parse (context, &error);
  const bool           ours    = !good && g_error_matches (error, G_MARKUP_ERROR, G_MARKUP_ERROR_INVALID_CONTENT);
  const std::string    why     = ours ? error->message : "";
  gint                 line    = 1;

  g_markup_parse_context_get_position (context, &line, nullptr);
  g_clear_error (&error);
  g_markup_parse_context_free (context);
  if (!good)
    throw IoFailure ("its " + file + " is damaged" +
                     (ours ? " (" + why + ")." : ", in line " + std::to_string (line) + "."));
  return std::move (open[0].children.at (0));
}
