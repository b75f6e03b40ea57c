// The manual page, made from what --help and --describe say: so that it never differs from them.
#pragma once

#include <string>

namespace rsc {

// rsc(1) for man, in roff.
std::string manual_page();

}  // namespace rsc
