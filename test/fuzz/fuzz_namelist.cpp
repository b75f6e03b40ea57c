// Any bytes as a case: they are read or refused with a message. What is read, printed as the
// effective namelist and read again, is the same. A first line "%..." is the argument of a --set.
#include "base/error.hpp"
#include "case/read_case.hpp"
#include "promise.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view text(reinterpret_cast<const char*>(data), size);
    rsc::Options options;
    if (!text.empty() && text[0] == '%') {
        const std::size_t end = text.find('\n');
        options.set.emplace_back(text.substr(1, end == text.npos ? end : end - 1));
        text.remove_prefix(end == text.npos ? size : end + 1);
    }
    try {
        const rsc::ReadCase read = rsc::read_case_text(text, "case", options);
        const std::string effective = rsc::effective_namelist(read);
        std::string again;
        try {
            const rsc::ReadCase twice = rsc::read_case_text(effective, "again");
            PROMISE(twice.study.has_value() == read.study.has_value(), effective);
            again = rsc::effective_namelist(twice);
        } catch (const rsc::Error& error) {
            again = error.what();
        }
        PROMISE(again == effective, effective + "\n--- read again:\n" + again);
        // Thousands of members take a while: one such text in 32 is enough.
        std::size_t members_wanted = 1;
        if (read.study)
            for (const rsc::Study::Axis& axis : read.study->axes)
                members_wanted = std::min<std::size_t>(members_wanted * axis.values.size(), 1000);
        if (read.study && (members_wanted <= 100 || size % 32 == 0)) {
            try {
                const auto members = rsc::expand_study(read.settings, *read.study);
                PROMISE(!members.empty() && members.size() <= rsc::kMostMembers, effective);
            } catch (const rsc::Error& error) {
                PROMISE(error.kind() == rsc::Failure::bad_input, error.what());
            }
        }
    } catch (const rsc::Error& error) {
        PROMISE(error.kind() == rsc::Failure::bad_input, error.what());
        PROMISE(error.what()[0] != '\0', "a refusal without a word");
    }
    return 0;
}
