// Writes OpenRaster 0.0.5 (https://www.openraster.org): a zip of PNG files and stack.xml, which lists the front layer
// first.
//
// The entry mimetype comes first, uncompressed and without extra fields, so that programs find its text at byte 38.
// PNG files are stored uncompressed, too.  All entries have the same date, so that equal layers make equal files.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "layers.hpp"

#include <glib.h>
#include <zip.h>

#include <cmath>
#include <deque>
#include <memory>

constexpr int thumbnail_side = 256;          // pixels, at most (OpenRaster)
constexpr int first_day      = (1 << 5) + 1; // 1 January 1980, the first date that zip can have

// ------------------------------------------------------------------ stack.xml

// A name as the value of an XML attribute; control characters, which XML cannot have, become spaces.
static std::string
escaped (const char *name)
{
  char       *valid = g_utf8_make_valid (name, -1);
  char       *markup;
  std::string text;

  for (char *c = valid; *c; c++)
    if (static_cast<unsigned char> (*c) < 0x20 || *c == 0x7f)
      *c = ' ';
  markup = g_markup_escape_text (valid, -1);
  text   = markup;
  g_free (valid);
  g_free (markup);
  return text;
}

static std::string
layer_path (size_t layer)
{
  std::string number = std::to_string (layer);

  return "data/layer" + std::string (number.size () < 3 ? 3 - number.size () : 0, '0') + number + ".png";
}

static std::string
stack_xml (const CeldIoStack &stack)
{
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<image version=\"0.0.5\" w=\"" +
                    std::to_string (stack.width) + "\" h=\"" + std::to_string (stack.height) +
                    "\" xres=\"72\" yres=\"72\">\n  <stack>\n";

  for (size_t i = stack.layers; i-- > 0;)
    {
      const CeldRect box = layer_box (stack.layer[i]);

      xml += "    <layer name=\"" + escaped (stack.layer[i].name) + "\" src=\"" + layer_path (i) + "\" x=\"" +
             std::to_string (box.x) + "\" y=\"" + std::to_string (box.y) +
             "\" opacity=\"1.0\" visibility=\"visible\" composite-op=\"svg:src-over\"/>\n";
    }
  return xml + "  </stack>\n</image>\n";
}

// ------------------------------------------------------------------ the thumbnail

// The merged picture, scaled down by means of premultiplied colours over boxes of pixels.
static Bytes
thumbnail (const CeldIoStack &stack)
{
  const double       scale = std::max (1.0, double (std::max (stack.width, stack.height)) / thumbnail_side);
  const int          width = std::max (1, int (stack.width / scale)), height = std::max (1, int (stack.height / scale));
  std::vector<float> small (4 * size_t (width) * size_t (height));

  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        const int top = int (int64_t (y) * stack.height / height), left = int (int64_t (x) * stack.width / width);
        const int bottom = int (int64_t (y + 1) * stack.height / height);
        const int right = int (int64_t (x + 1) * stack.width / width);
        double    sum[4] = { 0, 0, 0, 0 };
        float    *to = &small[4 * (size_t (y) * size_t (width) + size_t (x))];

        for (int j = top; j < bottom; j++)
          for (int i = left; i < right; i++)
            {
              const float *from = stack.merged + 4 * (size_t (j) * size_t (stack.width) + size_t (i));

              for (int c = 0; c < 3; c++)
                sum[c] += double (from[c] * from[3]);
              sum[3] += double (from[3]);
            }
        for (int c = 0; c < 3; c++)
          to[c] = sum[3] > 0 ? float (sum[c] / sum[3]) : 0;
        to[3] = float (sum[3] / ((bottom - top) * (right - left)));
      }
  return encode_png (width, height, small.data ());
}

// ------------------------------------------------------------------ the zip

// A zip file that is being written.  Its contents stay in memory until close ().
class Zip
{
public:
  explicit Zip (const std::string &path)
  {
    zip = zip_open (path.c_str (), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    if (!zip)
      fail ();
  }

  ~Zip ()
  {
    if (zip)
      zip_discard (zip);
  }

  Zip (const Zip &) = delete;
  Zip &operator= (const Zip &) = delete;

  void
  add (const std::string &name, Bytes &&bytes, bool compressed = false)
  {
    contents.push_back (std::move (bytes));

    zip_source_t *source = zip_source_buffer (zip, contents.back ().data (), contents.back ().size (), 0);
    zip_int64_t   index = source ? zip_file_add (zip, name.c_str (), source, ZIP_FL_ENC_UTF_8) : -1;

    if (source && index < 0)
      zip_source_free (source);
    if (index < 0 || zip_file_set_dostime (zip, zip_uint64_t (index), 0, first_day, 0) ||
        zip_set_file_compression (zip, zip_uint64_t (index), compressed ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 0))
      fail ();
  }

  void
  close ()
  {
    if (zip_close (zip))
      fail ();
    zip = nullptr;
  }

private:
  [[noreturn]] void fail () { throw IoFailure ("it cannot be written as a zip file."); }

  zip_t            *zip;
  std::deque<Bytes> contents; // a deque, which does not move its items
};

static Bytes
bytes_of (const std::string &text)
{
  return Bytes (text.begin (), text.end ());
}

void
write_open_raster (const std::string &path, const CeldIoStack &stack)
{
  NewFile file (path);
  Zip     zip (file.name ());

  zip.add ("mimetype", bytes_of ("image/openraster"));
  zip.add ("stack.xml", bytes_of (stack_xml (stack)), true);
  for (size_t i = 0; i < stack.layers; i++)
    {
      const CeldRect box = layer_box (stack.layer[i]);

      zip.add (layer_path (i), encode_png (box.width, box.height, layer_pixels (stack, i).data ()));
    }
  zip.add ("mergedimage.png", encode_png (stack.width, stack.height, stack.merged));
  zip.add ("Thumbnails/thumbnail.png", thumbnail (stack));
  zip.close ();
  file.commit ();
}
