#include <reference/rounding.h>
