// Records and sums of a campaign as bytes, for checkpoints and for other ranks. The bytes are in this machine's own
// format: the same program on the same kind of machine reads them back bit for bit. They are not meant to be kept.
#pragma once

#include <string>
#include <string_view>

#include "observe/record.hpp"

namespace rsc {

std::string to_bytes(const RealizationRecord& record);
// The sums alone; the options come from the case.
std::string to_bytes(const Accumulators& sums);

// Throw Error(internal) for bytes that are not what they should be.
RealizationRecord record_from_bytes(std::string_view bytes);
void sums_from_bytes(std::string_view bytes, Accumulators& sums);

// The number of the realization alone.
std::int64_t realization_of(std::string_view record_bytes);

// Changes when the layout of the bytes does.
std::string archive_layout();

}  // namespace rsc
