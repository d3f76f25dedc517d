#include <reference/specification.h>
