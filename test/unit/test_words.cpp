// Every word rsc says stands in a test: each piece of text in the sources of case/, read/, run/ and of the program, cut at what is filled
// in, is looked for among the expectations of the tests. A message that no test knows, and one that was changed, is found here; that it
// comes when it should, and with which status, the tests that hold it say (test_refusals.cpp, test_registry.cpp, test_screen.cpp, cli/).
#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "check.hpp"

namespace fs = std::filesystem;

namespace {

const fs::path root = fs::path(RSC_TEST_DATA).parent_path().parent_path();

// What no test can bring about, and why.
const struct {
    const char* text;
    const char* why;
} kBeyondTests[] = {
    {"eEdD", "no message"},
    {"/data/title", "no message"},
    {"datatype", "no message"},
    {"checktype", "no message"},
    {"/dev/stdin", "no message"},
    {"abandoned", "never shown: one task ends because another failed"},
    {"a signal handler may store it", "never shown: told by the compiler"},
    {"the list of units of UDUNITS cannot be read; set the environment's UDUNITS2_XML_PATH to its udunits2.xml",
     "the library ends the program's ability to ask for another list once one was read"},
    {"no memory to look into '", "memory runs out elsewhere first"},
    {"' (some 32 MB)", "memory runs out elsewhere first"},
    {"no memory for the files of", "memory runs out elsewhere first"},
    {"rsc: the machine refused memory; a smaller surface%n, fewer levels or solver%method='direct' need less",
     "where memory runs out is chance (cli/faults.sh: memory)"},
    {"the machine refused memory; fewer run%threads or a smaller surface%n need less",
     "where memory runs out is chance (cli/campaign.sh: memory)"},
    {"the machine refused to start a thread", "where threads run out is chance (cli/faults.sh: memory)"},
    {"the machine refused to start", "where threads run out is chance (cli/faults.sh: memory)"},
    {"threads; fewer run%threads need less", "where threads run out is chance (cli/faults.sh: memory)"},
    {"rsc: internal failure:", "a fault of rsc itself"},
    {"Please report it with the case that led here.", "a fault of rsc itself"},
    {"a campaign ended with", "a fault of rsc itself"},
    {"the summary of a member has not the length it should have", "a fault of rsc itself"},
    {"an unknown source of asperities", "a fault of rsc itself"},
    {"is not numeric", "those who read a variable ask before"},
    {"the length of data", "an array is stepped over, and so measured, before"},
    {": reading failed", "a disk that fails while it is read"},
    {": reading failed after line", "a disk that fails while it is read"},
    {"cannot be read; is the file whole? (", "HDF5 and the check of lengths find damage when a file is opened"},
    {"the list of variables", "as above"},
    {"the dimensions of", "as above"},
    {"a dimension of", "as above"},
    {"the levels of '", "the bins of distributions, compared before, differ where levels do"},
    {"' are others than those of '", "as above"},
    {"an answer of more than 2 GiB cannot be sent by MPI; take fewer map_cells or levels", "of rsc_mpi alone"},
    {"the machine refused memory", "of rsc_mpi alone"},
    {"this MPI library cannot be used by a program with threads", "of rsc_mpi alone"},
    {"points, take", "depends on the memory of the machine"},
    {"GB, and the machine has", "as above"},
    {"GB of memory; take fewer points a wave or a smaller surface%L_lambda_s", "as above"},
    {"heights and their transforms", "as above"},
};

std::string content_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// The texts in quotes of a C++ source, neighbours joined; comments, #include and single characters are none.
std::vector<std::string> texts_of(const std::string& code) {
    std::vector<std::string> texts;
    bool joins = false;  // nothing but blanks since the last text
    for (std::size_t i = 0; i < code.size(); ++i) {
        const char c = code[i];
        if (c == '/' && code[i + 1] == '/') {
            i = code.find('\n', i);
        } else if (code.compare(i, 8, "#include") == 0) {
            i = code.find('\n', i);
        } else if (c == '\'' && i > 0 && !std::isalnum(static_cast<unsigned char>(code[i - 1]))) {
            i += code[i + 1] == '\\' ? 3 : 2;
            joins = false;
        } else if (c == '"') {
            if (!joins) texts.emplace_back();
            for (++i; code[i] != '"'; ++i) {
                if (code[i] != '\\') {
                    texts.back() += code[i];
                    continue;
                }
                ++i;
                texts.back() += code[i] == 'n' || code[i] == 'r' || code[i] == 't' || code[i] == '0' ? '\n' : code[i];
                if (code[i] == 'x') i += 2;
            }
            joins = true;
        } else if (!std::isspace(static_cast<unsigned char>(c))) {
            joins = false;
        }
    }
    return texts;
}

// Cut where printf fills in and where a line ends.
std::vector<std::string> pieces_of(const std::string& text) {
    std::vector<std::string> pieces(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') {
            pieces.emplace_back();
        } else if (text[i] == '%' && i + 1 < text.size() && text[i + 1] == '%') {
            pieces.back() += text[i++];
        } else if (text[i] == '%') {
            const std::size_t end = text.find_first_not_of("+-0123456789.*lz", i + 1);
            const auto letter = [&](std::size_t k) { return k < text.size() && std::isalpha(static_cast<unsigned char>(text[k])) != 0; };
            const bool of_a_key = end == i + 1 && i > 0 && letter(i - 1) && letter(i + 2);  // surface%sigma
            if (end != std::string::npos && !of_a_key && std::strchr("dugfesc", text[end])) {
                pieces.emplace_back();
                i = end;
            } else {
                pieces.back() += '%';
            }
        } else {
            pieces.back() += text[i];
        }
    }
    for (std::string& piece : pieces) {
        while (!piece.empty() && piece.front() == ' ') piece.erase(0, 1);
        while (!piece.empty() && piece.back() == ' ') piece.pop_back();
    }
    return pieces;
}

// All that the tests expect: C++ as the texts mean it, everything else as it stands, with and without backslashes.
std::string expectations() {
    std::string all;
    for (const auto& entry : fs::recursive_directory_iterator(root / "test")) {
        const std::string name = entry.path().filename().string(), ending = entry.path().extension().string();
        if (!entry.is_regular_file() || name == "test_words.cpp" || name == "README") continue;
        const std::string text = content_of(entry.path());
        if (ending == ".cpp" || ending == ".hpp") {
            for (const std::string& t : texts_of(text)) all += t + '\n' + std::regex_replace(t, std::regex("%%"), "%") + '\n';
        } else if (ending == ".sh" || ending == ".cmake" || ending == ".txt" || ending == ".py") {
            all += text + '\n';
            std::copy_if(text.begin(), text.end(), std::back_inserter(all), [](char c) { return c != '\\'; });
        }
    }
    return all;
}

}  // namespace

int main() {
    std::vector<fs::path> sources = {root / "src/main.cpp", root / "src/file/output_path.cpp"};
    for (const char* room : {"case", "read", "run"})
        for (const auto& entry : fs::directory_iterator(root / "src" / room))
            if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp") sources.push_back(entry.path());
    std::sort(sources.begin(), sources.end());
    const std::string known = expectations();
    std::set<std::string> excuses;
    for (const auto& beyond : kBeyondTests) excuses.insert(beyond.text);
    std::set<std::string> unused = excuses;
    int pieces = 0;
    for (const fs::path& source : sources)
        for (const std::string& text : texts_of(content_of(source)))
            for (const std::string& piece : pieces_of(text)) {
                if (std::count_if(piece.begin(), piece.end(), [](unsigned char c) { return std::isalpha(c) != 0; }) < 3) continue;
                ++pieces;
                const bool found = known.find(piece) != std::string::npos, excused = excuses.contains(piece);
                unused.erase(piece);
                if (!found && !excused)
                    std::printf("in no test, src/%s: \"%s\"\n", fs::relative(source, root / "src").c_str(), piece.c_str());
                CHECK(found || excused);
            }
    CHECK(pieces > 800);
    for (const std::string& text : unused) std::printf("in no source any more, or in a test now: \"%s\"\n", text.c_str());
    CHECK(unused.empty());
    return check::summary();
}
