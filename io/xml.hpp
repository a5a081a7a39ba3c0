// The elements of an XML file, without its text.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_XML_HPP
#define CELDEPTH_XML_HPP

#include <map>
#include <string>
#include <vector>

struct XmlElement
{
  std::string                        name;
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement>            children;

  // The value of an attribute, or else `usual`; numbers beyond 2^53 and texts that are no numbers count as not given.
  std::string text (const std::string &attribute, const std::string &usual = "") const;
  double      number (const std::string &attribute, double usual) const;

  // The first child of that name; null if there is none.
  const XmlElement *child (const std::string &child_name) const;
};

// The root element.  Throws an IoFailure with the name of the file if it is no XML, or nested more than 100 deep.
XmlElement parse_xml (const std::string &text, const std::string &file);

#endif
