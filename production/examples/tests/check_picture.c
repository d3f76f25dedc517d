/* Checks a picture of the teapot: check_picture FILE
 * Checks its size, and that there is a teapot of a plausible size in the middle, with many shades, and none
 * at the edges. */
#include <png.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 800, HEIGHT = 600 };

static unsigned char pixels[HEIGHT][WIDTH][3];
static unsigned char seen[32][32][32];

/* Returns true for the blue-green of the teapot; everything else is grey or brown. */
static int is_teapot(const unsigned char* pixel) {
  return pixel[2] > pixel[0] + 12 && pixel[1] > pixel[0] + 12;
}

int main(int argc, char** argv) {
  png_image image = {.version = PNG_IMAGE_VERSION};
  if (argc != 2 || !png_image_begin_read_from_file(&image, argv[1])) return 2;
  image.format = PNG_FORMAT_RGB;
  if (image.width != WIDTH || image.height != HEIGHT ||
      !png_image_finish_read(&image, NULL, pixels, 0, NULL)) {
    fprintf(stderr, "%s: not a picture of %d x %d\n", argv[1], WIDTH, HEIGHT);
    return 1;
  }
  int inside = 0, at_edges = 0, shades = 0, brightest = 0, darkest = 255;
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x) {
      const unsigned char* pixel = pixels[y][x];
      if (!is_teapot(pixel)) continue;
      ++inside;
      at_edges += x < 20 || x >= WIDTH - 20 || y < 20 || y >= HEIGHT - 20;
      if (pixel[1] > brightest) brightest = pixel[1];
      if (pixel[1] < darkest) darkest = pixel[1];
      unsigned char* shade = &seen[pixel[0] / 8][pixel[1] / 8][pixel[2] / 8];
      shades += !*shade;
      *shade = 1;
    }
  printf("%d pixels of the teapot, %d at the edges, %d shades from %d to %d\n", inside, at_edges, shades,
         darkest, brightest);
  if (inside < WIDTH * HEIGHT / 6 || inside > WIDTH * HEIGHT / 2 || at_edges > 0) return 1;
  if (shades < 100 || darkest > 90 || brightest < 220) return 1;
  return 0;
}
