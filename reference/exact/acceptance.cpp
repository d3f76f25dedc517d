#include <reference/acceptance.h>
