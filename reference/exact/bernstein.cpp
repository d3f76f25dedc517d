#include <reference/bernstein.h>
