// The functions that make the seven files.
#pragma once

#include "document.h"

namespace evalcts::vectors {

Document map1_eval();
Document map2_eval();
Document grid();
Document auto_normal();
Document errors();
Document get_map();
Document state();

}  // namespace evalcts::vectors
