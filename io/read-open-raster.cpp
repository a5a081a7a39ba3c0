// The stack of an OpenRaster file (https://www.openraster.org/baseline/layer-stack-spec.html): stack.xml lists layers
// and nested stacks, the front one first.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-layered.hpp"
#include "xml.hpp"

#include <OpenImageIO/strutil.h>

#include <algorithm>

static bool
is_png (const std::string &name)
{
  return OIIO::Strutil::iends_with (name, ".png");
}

// The layers of a stack whose origin is (x, y).
static Layer
read_element (const ZipFile &zip, const XmlElement &element, double x, double y)
{
  Layer layer;

  x += element.number ("x", 0);
  y += element.number ("y", 0);
  layer.name       = element.text ("name");
  layer.opacity    = float (std::clamp (element.number ("opacity", 1), 0.0, 1.0));
  layer.visible    = element.text ("visibility", "visible") != "hidden";
  layer.multiplies = element.text ("composite-op") == "svg:multiply";
  layer.x          = place_number (x);
  layer.y          = place_number (y);
  layer.store      = element.name == "stack" ? Store::group : Store::png;
  for (size_t i = element.children.size (); layer.store == Store::group && i-- > 0;)
    if (element.children[i].name == "stack" || element.children[i].name == "layer")
      layer.children.push_back (read_element (zip, element.children[i], x, y));
  layer.entry = element.text ("src");
  if (layer.store == Store::png && !is_png (layer.entry))
    layer.problem = "it is stored as \"" + layer.entry + "\", and only PNG can be read.";
  else if (layer.store == Store::png && !zip.has (layer.entry))
    layer.problem = "the file has no " + layer.entry + ".";
  return layer;
}

LayeredPage
read_open_raster (const ZipFile &zip)
{
  const XmlElement  image = parse_xml (zip.bytes ("stack.xml", longest_xml), "stack.xml");
  const XmlElement *stack = image.child ("stack");
  const double      width = image.number ("w", 0), height = image.number ("h", 0);
  LayeredPage       page;

  if (image.name != "image" || !stack)
    throw IoFailure ("its stack.xml has no layers.");
  check_canvas (int64_t (width), int64_t (height));
  page.width        = int (width);
  page.height       = int (height);
  page.merged       = "mergedimage.png";
  page.root         = read_element (zip, *stack, 0, 0);
  page.root.opacity = 1;
  page.root.visible = true;
  return page;
}
