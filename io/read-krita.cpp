// The layers of a Krita document: maindoc.xml lists layers and groups, the front one first; the pixels of a layer are
// in NAME/layers/FILE, where NAME is that of the image.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-layered.hpp"
#include "xml.hpp"

#include <algorithm>

// The layers of the element `layers`; image: NAME/layers/.
static void
read_layers (const ZipFile &zip, const XmlElement &layers, const std::string &image, std::vector<Layer> &list)
{
  for (size_t i = layers.children.size (); i-- > 0;)
    {
      const XmlElement &element = layers.children[i];
      const XmlElement *inner   = element.child ("layers");
      const std::string kind = element.text ("nodetype"), colours = element.text ("colorspacename");
      Layer             layer;

      if (element.name != "layer")
        continue;
      layer.name       = element.text ("name");
      layer.opacity    = float (std::clamp (element.number ("opacity", 255), 0.0, 255.0) / 255);
      layer.visible    = element.text ("visible", "1") != "0";
      layer.multiplies = element.text ("compositeop") == "multiply";
      layer.x          = place_number (element.number ("x", 0));
      layer.y          = place_number (element.number ("y", 0));
      layer.entry      = image + element.text ("filename");
      if (kind == "grouplayer")
        layer.store = Store::group;
      else if (kind != "paintlayer")
        layer.problem = "it is no paint layer; convert it to one, or save the page as ORA or PSD.";
      else if (colours != "RGBA")
        layer.problem = "it has other colours than RGB in 8 bits; save the page as ORA or PSD.";
      else if (!zip.has (layer.entry))
        layer.problem = "the file has no " + layer.entry + ".";
      else
        layer.store = Store::krita_tiles;
      if (layer.store == Store::group && inner)
        read_layers (zip, *inner, image, layer.children);
      list.push_back (std::move (layer));
    }
}

LayeredPage
read_krita (const ZipFile &zip)
{
  const XmlElement  document = parse_xml (zip.bytes ("maindoc.xml", longest_xml), "maindoc.xml");
  const XmlElement *image = document.child ("IMAGE"), *layers = image ? image->child ("layers") : nullptr;
  LayeredPage       page;

  if (!layers)
    throw IoFailure ("its maindoc.xml has no layers.");
  check_canvas (int64_t (image->number ("width", 0)), int64_t (image->number ("height", 0)));
  page.width      = int (image->number ("width", 0));
  page.height     = int (image->number ("height", 0));
  page.merged     = "mergedimage.png";
  page.root.store = Store::group;
  read_layers (zip, *layers, image->text ("name") + "/layers/", page.root.children);
  return page;
}
