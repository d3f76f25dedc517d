/* The control points of the teapot's patches, from the rings of its body and the sections of its handle and
 * spout. */
#include "teapot_patches.h"

/* Body, lid, rim and bottom are round. A ring is approximately a quarter of a circle of radius r at height z,
 * with the control points (r,0), (r,k), (k,r), (0,r). Four rings make a patch, from the top down; the last
 * ring is the first one of the next patch. */
static const struct ring {
  float r, k, z;
} rings[] = {
    {0, 0, 3.15f}, /* the knob and the lid */
    {0.8f, 0.45f, 3.15f},
    {0, 0, 2.85f},
    {0.2f, 0.112f, 2.7f},
    {0.4f, 0.224f, 2.55f},
    {1.3f, 0.728f, 2.55f},
    {1.3f, 0.728f, 2.4f},
    {1.4f, 0.784f, 2.4f}, /* the rim */
    {1.3375f, 0.749f, 2.53125f},
    {1.4375f, 0.805f, 2.53125f},
    {1.5f, 0.84f, 2.4f},
    {1.75f, 0.98f, 1.875f}, /* the body */
    {2, 1.12f, 1.35f},
    {2, 1.12f, 0.9f},
    {2, 1.12f, 0.45f},
    {1.5f, 0.84f, 0.225f},
    {1.5f, 0.84f, 0.15f},
    {1.5f, 0.84f, 0.075f}, /* the bottom */
    {1.425f, 0.798f, 0},
    {0, 0, 0},
};
static const int first_rings[6] = {0, 3, 7, 10, 13, 16};

/* Handle and spout are tubes. A section is half of the circumference: (x0,0,z0), (x0,-w,z0), (x1,-w,z1),
 * (x1,0,z1). */
static const struct section {
  float x0, z0, x1, z1, w;
} sections[] = {
    {-1.6f, 2.025f, -1.5f, 2.25f, 0.3f}, /* the handle, from the top down */
    {-2.3f, 2.025f, -2.5f, 2.25f, 0.3f},    {-2.7f, 2.025f, -3, 2.25f, 0.3f},
    {-2.7f, 1.8f, -3, 1.8f, 0.3f},          {-2.7f, 1.575f, -3, 1.35f, 0.3f},
    {-2.5f, 1.125f, -2.65f, 0.9375f, 0.3f}, {-2, 0.9f, -1.9f, 0.6f, 0.3f},
    {1.7f, 1.425f, 1.7f, 0.6f, 0.66f}, /* the spout, from the body outward */
    {2.6f, 1.425f, 3.1f, 0.825f, 0.66f},    {2.3f, 2.1f, 2.4f, 2.025f, 0.25f},
    {2.7f, 2.4f, 3.3f, 2.4f, 0.25f},        {2.8f, 2.475f, 3.525f, 2.49375f, 0.25f},
    {2.9f, 2.475f, 3.45f, 2.5125f, 0.15f},  {2.8f, 2.4f, 3.2f, 2.4f, 0.15f},
};
static const int first_sections[4] = {0, 3, 7, 10};

static void set(float point[3], float x, float y, float z) {
  point[0] = x;
  point[1] = y;
  point[2] = z;
}

/* Computes the points of a ring in quarter number `quarter`, clockwise seen from above. */
static void place_ring(struct ring ring, int quarter, float points[4][3]) {
  const float x[4] = {ring.r, ring.r, ring.k, 0}, y[4] = {0, -ring.k, -ring.r, -ring.r};
  for (int i = 0; i < 4; ++i) switch (quarter) {
      case 0:
        set(points[i], x[i], y[i], ring.z);
        break;
      case 1:
        set(points[i], y[i], -x[i], ring.z);
        break;
      case 2:
        set(points[i], -x[i], -y[i], ring.z);
        break;
      default:
        set(points[i], -y[i], x[i], ring.z);
    }
}

/* Computes the points of a section, or of its mirror image in reverse order, so that the normal still points
 * outward. */
static void place_section(struct section s, int mirrored, float points[4][3]) {
  set(points[mirrored ? 3 : 0], s.x0, 0, s.z0);
  set(points[mirrored ? 2 : 1], s.x0, mirrored ? s.w : -s.w, s.z0);
  set(points[mirrored ? 1 : 2], s.x1, mirrored ? s.w : -s.w, s.z1);
  set(points[mirrored ? 0 : 3], s.x1, 0, s.z1);
}

void teapot_patch(int index, float points[4][4][3]) {
  for (int j = 0; j < 4; ++j) {
    if (index < 24)
      place_ring(rings[first_rings[index / 4] + j], index % 4, points[j]);
    else
      place_section(sections[first_sections[(index - 24) / 2] + j], index % 2, points[j]);
  }
}
