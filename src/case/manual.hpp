// The manual page, made from what --help and --describe say: nothing stands in it that could grow old.
#pragma once

#include <string>

namespace rsc {

// rsc(1) for man, in roff.
std::string manual_page();

}  // namespace rsc
