#include <reference/component.h>
