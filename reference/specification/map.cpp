#include <reference/map.h>
