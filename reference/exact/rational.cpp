#include <reference/rational.h>
