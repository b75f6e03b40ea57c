#include "file/netcdf_writer.hpp"

#include <cctype>
#include <cstdlib>
#include <ctime>

#include "error.hpp"
#include "file/netcdf_table.hpp"
#include "version.h"

namespace rsc {
namespace {

std::string date() {
    std::time_t now = std::time(nullptr);
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
        char* end = nullptr;
        const long long seconds = std::strtoll(epoch, &end, 10);
        if (end != epoch && *end == '\0') now = static_cast<std::time_t>(seconds);
    }
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

}  // namespace

std::string unit_of(const std::string& length_unit, int length_power, const std::string& force_unit, int force_power) {
    std::string text;
    const auto factor = [&text](const std::string& unit, int power) {
        if (power == 0 || unit.empty() || unit == "1") return;
        bool plain = true;
        for (char c : unit)
            plain = plain && (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || static_cast<unsigned char>(c) >= 0x80);
        if (!text.empty()) text += ' ';
        text += plain ? unit : "(" + unit + ")";
        if (power != 1) text += std::to_string(power);
    };
    // A positive power comes first: "N mm-2", "mm2 N-1".
    if (force_power > 0) factor(force_unit, force_power);
    factor(length_unit, length_power);
    if (force_power < 0) factor(force_unit, force_power);
    return text.empty() ? "1" : text;
}

std::string history_text(const std::string& command) { return date() + " " + (command.empty() ? "rsc " RSC_VERSION : command); }

void write_result(const Result& result, const std::string& path, const WriteOptions& options) {
    const Observations& o = result.observations;
    if (o.realizations == 0 || o.steps == 0) throw Error(Failure::internal, "result file: there is nothing to write, no level was run");
    ResultTable(result).make(history_text(options.command)).write(path, options.format, options.compression);
}

}  // namespace rsc
