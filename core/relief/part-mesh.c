/* The mesh of a part: squares of pixels inside it, merged where it is flat, and triangles along its outline.
 *
 * A surface is open at the back.  A solid has a flat back, and walls along its outline: each part is a closed body of
 * its own that stands in the plate.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/parts.h"

#include <math.h>

typedef struct
{
  CeldRelief      squares;      /* the part's pixels as corners of squares, and where those that it fills are cut off */
  CeldMeshPoints  points;
  CeldQuadtree    quadtree;
  uint8_t        *skipped;      /* squares with less than four pixels inside */
  CeldPartOutline outline;
  CeldMeshBuilder builder;
  bool            solid;
} PartWork;

static CeldStatus
work_new (const CeldPart *part, PartWork *work)
{
  int    w = part->box.width - 1, h = part->box.height - 1;
  size_t n = (size_t) part->box.width * (size_t) part->box.height, squares = (size_t) w * (size_t) h;

  work->squares        = (CeldRelief) { .width = w, .height = h };
  work->points         = (CeldMeshPoints) { .width = w, .height = h, .n = n };
  work->squares.cut    = celd_alloc0 (squares, 1);
  work->skipped        = celd_alloc0 (squares, 1);
  work->points.first   = celd_alloc (n + 1, sizeof *work->points.first);
  work->points.part    = celd_alloc0 (n, 1);
  work->points.cracked = celd_alloc0 (n, 1);
  work->points.z       = celd_alloc (n, sizeof *work->points.z);
  work->builder.vertex = celd_alloc (n, sizeof *work->builder.vertex);
  return work->squares.cut && work->skipped && work->points.first && work->points.part && work->points.cracked &&
         work->points.z && work->builder.vertex ? CELD_OK : CELD_NO_MEMORY;
}

static void
work_clear (PartWork *work)
{
  celd_free (work->squares.cut);
  celd_free (work->skipped);
  celd_free (work->builder.vertex);
  celd_mesh_points_clear (&work->points);
  celd_quadtree_clear (&work->quadtree);
  celd_part_outline_clear (&work->outline);
}

/* ------------------------------------------------------------------ squares */

static bool
is_skipped (const CeldPart *part, int x, int y)
{
  return !celd_part_has (part, x, y) || !celd_part_has (part, x + 1, y) || !celd_part_has (part, x, y + 1) ||
         !celd_part_has (part, x + 1, y + 1);
}

/* Every pixel is a point; those at squares that are skipped become vertices. */
static void
make_points (const CeldPart *part, PartWork *work)
{
  for (size_t i = 0; i < work->points.n; i++)
    {
      work->points.first[i] = (uint32_t) i;
      work->points.z[i]     = part->coverage[i] > CELD_COVERED ? part->z[i] : 0;
    }
  work->points.first[work->points.n] = (uint32_t) work->points.n;
  for (int y = 0; y < work->squares.height; y++)
    for (int x = 0; x < work->squares.width; x++)
      {
        work->skipped[(size_t) y * (size_t) work->squares.width + (size_t) x] = is_skipped (part, x, y);
        for (int k = 0; k < 4 && is_skipped (part, x, y); k++)
          if (celd_part_has (part, x + k % 2, y + k / 2))
            work->points.cracked[celd_part_at (part, x + k % 2, y + k / 2)] = true;
      }
}

/* Cuts squares off that are skipped, so that none is merged. */
static void
cut_squares (PartWork *work)
{
  size_t w = (size_t) work->squares.width, n = w * (size_t) work->squares.height;

  for (size_t i = 0; i < n; i++)
    {
      if (work->skipped[i] || ((i + 1) % w && work->skipped[i + 1]))
        work->squares.cut[i] |= CELD_CUT_RIGHT;
      if (work->skipped[i] || (i + w < n && work->skipped[i + w]))
        work->squares.cut[i] |= CELD_CUT_BELOW;
    }
}

/* ------------------------------------------------------------------ the back */

static CeldStatus
mesh_new (CeldReliefMesh *mesh, size_t n)
{
  mesh->place  = celd_alloc (n, 3 * sizeof *mesh->place);
  mesh->normal = celd_alloc0 (n, 3 * sizeof *mesh->normal);
  mesh->art    = celd_alloc (n, 2 * sizeof *mesh->art);
  return mesh->place && mesh->normal && mesh->art ? CELD_OK : CELD_NO_MEMORY;
}

/* Closes the front by a flat back with the same triangles, and walls between the two. */
static CeldStatus
close_back (const CeldPartOutline *outline, CeldMeshBuilder *m, double bottom)
{
  uint32_t   n = (uint32_t) m->mesh.vertices;
  size_t     triangles = m->mesh.triangles;
  CeldStatus status = CELD_OK;

  memcpy (m->mesh.place + 3 * (size_t) n, m->mesh.place, 3 * (size_t) n * sizeof *m->mesh.place);
  memcpy (m->mesh.art + 2 * (size_t) n, m->mesh.art, 2 * (size_t) n * sizeof *m->mesh.art);
  for (size_t i = n; i < 2 * (size_t) n; i++)
    m->mesh.place[3 * i + 2] = (float) (m->scale * bottom);
  m->mesh.vertices = 2 * (size_t) n;
  for (size_t i = 0; i < triangles && status == CELD_OK; i++)
    {
      uint32_t a = m->mesh.corner[3 * i], b = m->mesh.corner[3 * i + 1], c = m->mesh.corner[3 * i + 2];

      status = celd_mesh_add_triangle (m, a + n, c + n, b + n);
    }
  for (size_t i = 0; i < outline->edges && status == CELD_OK; i++)
    {
      uint32_t from = outline->edge[2 * i], to = outline->edge[2 * i + 1];

      status = celd_mesh_add_triangle (m, to, from, from + n);
      if (status == CELD_OK)
        status = celd_mesh_add_triangle (m, to, from + n, to + n);
    }
  return status;
}

/* ------------------------------------------------------------------ the mesh */

static CeldStatus
fill (const CeldPart *part, double error, double bottom, const CeldHost *host, PartWork *work)
{
  CeldMeshBuilder *m = &work->builder;
  size_t           n = 0;
  CeldStatus       status = celd_quadtree_new (&work->points, &work->squares, error / 2, host, &work->quadtree);

  m->relief   = &work->squares;
  m->points   = &work->points;
  m->quadtree = &work->quadtree;
  m->skipped  = work->skipped;
  if (status == CELD_OK)
    status = celd_mesh_mark_points (m, host, &n);
  if (status == CELD_OK)
    status = mesh_new (&m->mesh, (n + celd_part_crossings (part)) * (work->solid ? 2 : 1));
  if (status == CELD_OK)
    {
      celd_mesh_make_vertices (m);
      status = celd_mesh_fill_squares (m, host);
    }
  if (status == CELD_OK)
    status = celd_part_outline_new (part, m, &work->outline);
  if (status == CELD_OK)
    status = celd_part_outline_fill (&work->outline);
  if (status == CELD_OK && work->solid)
    status = close_back (&work->outline, m, bottom);
  if (status == CELD_OK)
    celd_mesh_normals (&m->mesh);
  return status;
}

/* The page is a plane, or as a solid a plate. */
static CeldStatus
fill_page (const CeldParts *parts, bool solid, double bottom, CeldMeshBuilder *m)
{
  static const int wall[5] = { 0, 1, 2, 3, 0 };
  int              n = solid ? 8 : 4;
  CeldStatus       status = mesh_new (&m->mesh, (size_t) n);

  if (status != CELD_OK)
    return status;
  for (int k = 0; k < n; k++)
    celd_mesh_add_vertex (m, 0.5 + (k % 4 / 2 ? parts->width : 0), 0.5 + ((k + 1) % 4 / 2 ? parts->height : 0),
                          k < 4 ? 0 : bottom);
  status = celd_mesh_add_triangle (m, 0, 1, 2);
  if (status == CELD_OK)
    status = celd_mesh_add_triangle (m, 0, 2, 3);
  if (status == CELD_OK && solid)
    status = celd_mesh_add_triangle (m, 4, 6, 5);
  if (status == CELD_OK && solid)
    status = celd_mesh_add_triangle (m, 4, 7, 6);
  for (int k = 0; k < 4 && status == CELD_OK && solid; k++)
    {
      uint32_t from = (uint32_t) wall[k], to = (uint32_t) wall[k + 1];

      status = celd_mesh_add_triangle (m, to, from, from + 4);
      if (status == CELD_OK)
        status = celd_mesh_add_triangle (m, to, from + 4, to + 4);
    }
  if (status == CELD_OK)
    celd_mesh_normals (&m->mesh);
  return status;
}

CeldStatus
celd_part_mesh (const CeldParts *parts, size_t k, const CeldAtlasPlace *place, double error, double bottom,
                const CeldSettings *settings, const CeldHost *host, CeldReliefMesh *mesh)
{
  const CeldPart *part = &parts->item[k];
  int             side = parts->width > parts->height ? parts->width : parts->height;
  PartWork        work = { .solid = settings->mesh_kind == CELD_MESH_SOLID };
  CeldStatus      status = CELD_OK;

  work.builder.scale      = (double) settings->mesh_size / side;
  work.builder.centre_x   = 0.5 * parts->width - part->box.x - 0.5;
  work.builder.centre_y   = 0.5 * parts->height - part->box.y - 0.5;
  work.builder.art_x      = place->x + 0.5;
  work.builder.art_y      = place->y + 0.5;
  work.builder.art_width  = place->width;
  work.builder.art_height = place->height;
  if (part->page)
    status = fill_page (parts, work.solid, bottom, &work.builder);
  else
    {
      status = work_new (part, &work);
      if (status == CELD_OK)
        {
          make_points (part, &work);
          cut_squares (&work);
          status = fill (part, error, bottom, host, &work);
        }
    }
  if (status == CELD_OK)
    *mesh = work.builder.mesh;
  else
    celd_relief_mesh_clear (&work.builder.mesh);
  work_clear (&work);
  return status;
}
