#include "io/formats.hpp"

#include "base/error.hpp"
#include "case/namelist.hpp"
#include "case/units.hpp"

namespace rsc {
namespace {

using Mention = TextTable::UnitMention;

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

// The separator of the numbers of a file, and its decimal mark; each is unknown (0) until first
// seen, and fixed afterwards.
struct Style {
    char separator = 0;  // ' ', ',' or ';'
    char decimal = 0;    // '.' or ','
    long line = 0;       // where the separator was first seen
    long decimal_line = 0;
};

const char* name_of(char separator) {
    return separator == ' ' ? "blanks" : separator == ',' ? "commas" : "semicolons";
}

[[noreturn]] void refuse(const std::string& path, long line, const auto&... what) {
    bad_input(path, ":", line, ": ", what...);
}

double number(std::string_view word, const std::string& path, long line, std::size_t column,
              Style& style) {
    const std::string place = shown(word) + " in column " + std::to_string(column);
    std::string text(word);
    if (style.separator == ';') {
        const std::size_t mark = text.find_first_of(".,");
        if (mark != std::string::npos) {
            if (style.decimal == 0) {
                style.decimal = text[mark];
                style.decimal_line = line;
            }
            if (style.decimal != text[mark])
                refuse(path, line, place, ": a decimal ", text[mark] == ',' ? "comma" : "point",
                       ", where line ", style.decimal_line, " has decimal ",
                       style.decimal == ',' ? "commas" : "points");
            if (text[mark] == ',') {
                if (text.find('.') != std::string::npos)
                    refuse(path, line, place, " is not a number");
                text[mark] = '.';
            }
        }
    }
    const auto value = number_in_file(text);
    if (!value)
        refuse(path, line, place,
               " is not a number; comments begin with '#', a missing point of a map is nan");
    if (!std::isfinite(*value))
        refuse(path, line, place,
               " is not finite: every value must be known (missing points of a map: "
               "surface%missing)");
    return *value;
}

// The numbers in a line, and whether a comma or semicolon follows the last.
struct Row {
    std::size_t count = 0;
    bool open_end = false;
};

// Appends the numbers of a line to `values`.
Row parse(std::string_view text, const std::string& path, long line, Style& style, bool missing,
          std::vector<double>& values) {
    text = text.substr(0, text.find('#'));
    const bool semicolons = text.find(';') != std::string_view::npos;
    const auto separates = [semicolons](char c) { return c == (semicolons ? ';' : ','); };
    const auto require = [&](char found, const std::string& before) {
        if (style.separator == 0) {
            style.separator = found;
            style.line = line;
        }
        if (style.separator == found) return;
        const bool here = style.line == line;
        // In "0,01 0,02" one of two apparent separators may be a decimal comma.
        const std::string hint =
            style.separator != ';' && found != ';'
                ? "; decimal commas are accepted only with semicolons as separators"
                : "";
        refuse(path, line, name_of(found), " before ", before, " where ",
               here ? std::string("the rest of the line") : "line " + std::to_string(style.line),
               " has ", name_of(style.separator), ": one separator is expected throughout", hint);
    };
    std::size_t count = 0, i = 0;
    char gap = 0;  // separator since the last number
    if (semicolons) require(';', "the end");
    while (true) {
        while (i < text.size() && blank(text[i])) {
            if (gap == 0) gap = ' ';
            ++i;
        }
        if (i == text.size()) break;
        if (separates(text[i])) {
            if (gap == text[i] || count == 0) {  // an empty cell
                if (!missing)
                    refuse(path, line, "nothing between the separators at column ", count + 1,
                           ": empty cells of a map are missing points (surface%missing)");
                require(text[i], "an empty cell");
                values.push_back(std::nan(""));
                ++count;
            }
            gap = text[i++];
            continue;
        }
        const std::size_t start = i;
        while (i < text.size() && !blank(text[i]) && !separates(text[i])) ++i;
        const std::string_view word = text.substr(start, i - start);
        if (count > 0) require(gap, shown(word));
        const std::string lower = missing ? namelist::lower_case(word) : "";
        values.push_back(lower == "nan" || lower == "bad"
                             ? std::nan("")
                             : number(word, path, line, count + 1, style));
        ++count;
        gap = 0;
    }
    return {count, count > 0 && gap != 0 && gap != ' '};
}

// --- units in comments

bool contains_word(std::string_view text, std::string_view word) {
    const auto letter = [&](std::size_t i) {
        return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0;
    };
    for (std::size_t at = text.find(word); at != std::string_view::npos;
         at = text.find(word, at + 1))
        if (!letter(at + word.size()) && (at == 0 || !letter(at - 1))) return true;
    return false;
}

// True for the name of a coordinate before its unit, as in "x [um]".
bool names_coordinate(const std::string& word) {
    const std::string lower = namelist::lower_case(word);
    return lower == "x" || lower == "y" || lower == "xy";
}

// True for words that always mean a unit of length. Others, such as m and in, mean one only in
// brackets or after a number.
bool always_a_length(const std::string& word) {
    for (const char* const symbol :
         {"nm", "um", "mm", "pm", "cm", "\xc2\xb5m", "\xce\xbcm", "\xc3\x85", "\xe2\x84\xab"})
        if (word == symbol) return true;
    const std::string lower = namelist::lower_case(word);
    const auto begins = [&](const char* stem) { return lower.starts_with(stem); };
    return begins("angstrom") || begins("micron") ||
           ((begins("nano") || begins("micro") || begins("milli") || begins("pico") ||
             begins("centi")) &&
            (lower.find("meter") != std::string::npos || lower.find("metre") != std::string::npos));
}

// A word as UDUNITS spells it: names in lower case, with the kind of A that it knows.
std::string as_unit(const std::string& word) {
    if (word == "\xe2\x84\xab") return "\xc3\x85";
    return word.size() > 4 ? namelist::lower_case(word) : word;
}

// The words of a comment between blanks and punctuation, numbers apart from what follows them.
struct CommentWord {
    std::string text;
    std::optional<double> number;
    bool bracketed = false;
};
std::vector<CommentWord> words_of(std::string_view comment) {
    constexpr std::string_view between = " \t\r,;:=\"'#/";
    constexpr std::string_view open = "[({<", closed = "])}>";
    std::vector<CommentWord> words;
    bool inside = false;
    for (std::size_t i = 0; i < comment.size();) {
        if (open.find(comment[i]) != std::string_view::npos) inside = true;
        if (closed.find(comment[i]) != std::string_view::npos) inside = false;
        const auto ends = [&](std::size_t k) {
            return k >= comment.size() || between.find(comment[k]) != std::string_view::npos ||
                   open.find(comment[k]) != std::string_view::npos ||
                   closed.find(comment[k]) != std::string_view::npos;
        };
        if (ends(i)) {
            ++i;
            continue;
        }
        std::size_t end = i;
        while (!ends(end)) ++end;
        std::size_t digits = i;
        while (digits < end &&
               std::string_view("0123456789.+-").find(comment[digits]) != std::string_view::npos)
            ++digits;
        const std::string whole(comment.substr(i, end - i));
        if (const auto number = number_in_file(whole)) {
            words.push_back({whole, number, inside});
        } else {
            const auto start = number_in_file(comment.substr(i, digits - i));
            if (start) words.push_back({whole.substr(0, digits - i), start, inside});
            words.push_back({start ? whole.substr(digits - i) : whole, {}, inside});
        }
        i = end;
    }
    return words;
}

// The lengths of a comment's `label` and of its value after a colon or `=`.
struct LabelAndValue {
    std::string_view label, value;
};
std::optional<LabelAndValue> label_and_value(std::string_view comment) {
    constexpr std::string_view wide_colon = "\xef\xbc\x9a";  // of Japanese headers
    const std::size_t plain = comment.find_first_of(":=");
    const std::size_t wide = comment.find(wide_colon);
    if (plain == wide) return {};  // there is neither
    return plain < wide
               ? LabelAndValue{comment.substr(0, plain), comment.substr(plain + 1)}
               : LabelAndValue{comment.substr(0, wide), comment.substr(wide + wide_colon.size())};
}

// Gwyddion writes its header in the language of its user, but always the width, the height and the
// unit of the values in three lines. True if the lines before `line` are the first two, in words
// other than English.
bool after_sides(const std::vector<Mention>& found, long line) {
    const std::size_t n = found.size();
    if (n < 2 || (found[n - 2].kind == Mention::width && found[n - 1].kind == Mention::height))
        return false;
    for (const std::size_t k : {n - 2, n - 1})
        if (!(found[k].size > 0) || found[k].line != line - long(n - k)) return false;
    return true;
}

// The unit of `# Value units: m`.
void find_stated_unit(const LabelAndValue& stated, long line, std::vector<Mention>& found) {
    const std::string label = namelist::lower_case(stated.label);
    const std::vector<CommentWord> value = words_of(stated.value);
    if (value.size() <= 1 && after_sides(found, line)) {
        found[found.size() - 2].kind = Mention::width;
        found[found.size() - 1].kind = Mention::height;
        found.push_back({Mention::values, value.empty() ? "" : as_unit(value[0].text), 0, line});
        return;
    }
    if (value.empty() || !(contains_word(label, "units") || contains_word(label, "unit"))) return;
    bool lateral = false;
    for (const char* const word : {"x", "y", "xy", "lateral", "width", "scan", "pixel"})
        lateral = lateral || contains_word(label, word);
    found.push_back({lateral ? Mention::coordinates : Mention::values,
                     as_unit(value[0].number && value.size() > 1 ? value[1].text : value[0].text),
                     0, line});
}

// Units of length named in a comment: `# Value units: m`, `# Width: 10 um` as Gwyddion writes them,
// `# Exported image units: nm`, `# z [nm]`, `# Einheit: m`, ...
void find_units(std::string_view comment, long line, std::vector<Mention>& found) {
    const auto stated = label_and_value(comment);
    const std::size_t before = found.size();
    if (stated) find_stated_unit(*stated, line, found);
    if (found.size() > before) return;
    std::vector<CommentWord> words = words_of(stated ? stated->label : comment);
    const std::size_t of_label = stated ? words.size() : 0;
    if (stated)
        for (const CommentWord& word : words_of(stated->value)) words.push_back(word);
    const bool alone = stated && words.size() == of_label + 1;
    const bool side = stated && words.size() == of_label + 2 && words[of_label].number;
    for (const auto k : indices(words)) {
        const bool after_number = k > 0 && words[k - 1].number && words[k].text != "in";
        const std::string unit = as_unit(words[k].text);
        if (words[k].number || !(always_a_length(words[k].text) || after_number ||
                                 words[k].bracketed || (alone && k == of_label)))
            continue;
        if (unit_factor(unit, "m") == 0) continue;
        const bool coordinate = k > 0 && names_coordinate(words[k - 1].text);
        Mention mention{coordinate ? Mention::coordinates : Mention::other, unit, 0, line};
        if (side && k == of_label + 1) {
            const std::string label = namelist::lower_case(stated->label);
            if (contains_word(label, "width")) mention.kind = Mention::width;
            if (contains_word(label, "height")) mention.kind = Mention::height;
            mention.size = *words[of_label].number;
        }
        found.push_back(mention);
    }
}

}  // namespace

const Mention* TextTable::mention(UnitMention::Kind kind) const {
    const auto found = std::ranges::find(units, kind, &UnitMention::kind);
    return found == units.end() ? nullptr : &*found;
}

bool TextTable::picture() const {
    const Mention* const w = mention(Mention::width);
    const Mention* const h = mention(Mention::height);
    return w && h && h->line == w->line + 1;
}

std::optional<double> number_in_file(std::string_view word) {
    const std::size_t sign = word.find_first_of("+-", 1);
    if (sign != std::string_view::npos && word[sign - 1] < 'A') return {};
    return namelist::to_real(word);
}

// Puts an empty cell at the end of every row but the last, which has one more value than they.
static void add_empty_column(TextTable& table) {
    std::vector<double> wider;
    wider.reserve(table.values.size() + table.line.size());
    for (const auto row : indices(table.line)) {
        const auto start = table.values.begin() + std::ptrdiff_t(row * table.columns);
        wider.insert(wider.end(), start, start + std::ptrdiff_t(table.columns));
        wider.push_back(std::nan(""));
    }
    wider.insert(wider.end(),
                 table.values.begin() + std::ptrdiff_t(table.line.size() * table.columns),
                 table.values.end());
    table.values = std::move(wider);
    ++table.columns;
}

// True for a line that begins with a word: a heading, a name with a value.
static bool begins_with_word(std::string_view text) {
    text = text.substr(std::min(text.find_first_not_of(" \t\""), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(" \t,;=:\r\""));
    return !word.empty() &&
           (std::isalpha(static_cast<unsigned char>(word[0])) || word[0] == '\\' ||
            word[0] == '[') &&
           !number_in_file(word);
}

// The last line of the heading that begins with `first` at `line`, of which `file` holds the rest;
// 0 if the first line is none.
static long heading_end(const std::string& path, std::streambuf& file, std::string_view first,
                        long line) {
    if (!begins_with_word(first)) return 0;
    long last = line;
    std::string text;
    bool binary = false;
    bool heading = true;
    while (next_line(file, text)) {
        binary = binary || text.find('\0') != std::string::npos;
        heading = heading && begins_with_word(text);
        if (heading) ++last;
    }
    if (first.substr(0, 2) == "\\*" || binary)
        refuse(path, line, "the head of an instrument's file. ", gwyddion_advice(path));
    return last;
}

std::string gwyddion_advice(const std::string& path) {
    return "If Gwyddion reads it, this makes a file that rsc reads: gwyddion --convert-to-gwy=" +
           copy_for_shell(path, "_converted.gwy") + " " + for_shell(path);
}

namespace {

// Removes the mark of UTF-8 from the first line; refuses UTF-16.
void require_text(const std::string& path, std::string_view& view) {
    if (view.substr(0, 3) == "\xef\xbb\xbf") view.remove_prefix(3);
    if (view.substr(0, 2) == "\xff\xfe" || view.substr(0, 2) == "\xfe\xff")
        bad_input(
            path,
            ": is text in UTF-16; this makes a file that rsc reads: iconv -f UTF-16 -t UTF-8 ",
            for_shell(path), " > ", copy_for_shell(path, "_utf8.txt"));
}

// The lines of a table, after `heading` lines that are no numbers.
class TableReader {
public:
    TableReader(const std::string& path, std::size_t columns, bool missing, long heading)
        : path_(path), columns_(columns), missing_(missing), heading_(heading), file_(path) {
        table_.columns = columns;
    }

    TextTable read() {
        std::string text;
        while (next_line(file_, text)) {
            ++line_;
            std::string_view view(text);
            if (line_ == 1) require_text(path_, view);
            if (view.find('\0') != std::string_view::npos)
                refuse(path_, line_, "neither text nor a NetCDF file (there is a zero byte)");
            if (const std::size_t mark = view.find('#'); mark != std::string_view::npos)
                find_units(utf8(view.substr(mark + 1)), line_, table_.units);
            if (line_ <= heading_) continue;
            if (heading_ == 0 && table_.line.empty()) refuse_heading(view);
            add(view);
        }
        table_.rows = table_.line.size();
        if (table_.rows == 0) bad_input(path_, ": contains no numbers");
        return std::move(table_);
    }

private:
    // Refuses a file whose first line of text is not a comment. What is to be done about it is told
    // if it makes a table of the rest.
    void refuse_heading(std::string_view first) {
        const long last = heading_end(path_, file_, first, line_);
        if (last == 0) return;
        const std::string lines = last > line_ ? joined("lines ", line_, " to ", last, " begin")
                                               : joined("line ", line_, " begins");
        try {
            (void)TableReader(path_, columns_, missing_, last).read();
        } catch (const Error& error) {
            refuse(path_, line_, lines,
                   " with a word, not a number, and the rest is no table: ", error.what());
        }
        const bool esri = namelist::lower_case(first.substr(0, 5)) == "ncols";
        refuse(path_, line_, lines, " with a word, not a number: put '#' before each line of text",
               esri ? ", and give an ESRI grid's cellsize as surface%pixel and its NODATA_value as "
                      "surface%missing_value"
                    : "; a unit there is read");
    }

    void add(std::string_view view) {
        Row row = parse(view, path_, line_, style_, missing_, table_.values);
        if (row.count == 0) return;
        if (table_.columns == 0) table_.columns = row.count;
        if (missing_ && row.open_end && row.count + 1 == table_.columns) {
            table_.values.push_back(std::nan(""));  // the last cell is empty
            ++row.count;
        }
        if (missing_ && open_ends_ && columns_ == 0 && row.count == table_.columns + 1)
            add_empty_column(table_);  // all rows before end in an empty cell
        open_ends_ = open_ends_ && row.open_end;
        if (row.count != table_.columns) {
            const std::string expected =
                columns_ > 0 ? joined(columns_)
                             : joined(table_.columns, " as in line ", table_.line[0]);
            refuse(path_, line_, row.count, " values where ", expected, " were expected");
        }
        table_.line.push_back(line_);
    }

    const std::string& path_;
    std::size_t columns_;
    bool missing_;
    long heading_, line_ = 0;
    bool open_ends_ = true;  // every row so far ends with a separator
    UnpackedFile file_;
    Style style_;
    TextTable table_;
};

}  // namespace

TextTable read_table(const std::string& path, std::size_t columns, bool missing) {
    return TableReader(path, columns, missing, 0).read();
}

namespace {

// Units in the line above the numbers, one for each column, as in "Lateral (um), Profile (nm)".
void find_column_units(const std::string& heading, long line, std::size_t columns,
                       std::vector<Mention>& found) {
    std::vector<Mention> units;
    find_units(heading, line, units);
    if (units.size() != columns) return;
    for (Mention& unit : units) unit.kind = Mention::coordinates;
    units.back().kind = Mention::values;
    found.insert(found.end(), units.begin(), units.end());
}

// The step and the unit in the heading of SigmaSurf's texts.
void find_sigmasurf(std::string_view text, long line, std::vector<Mention>& found) {
    const auto stated = label_and_value(text);
    if (!stated) return;
    if (stated->label == "PROFILE_UM") found.push_back({Mention::values, "um", 0, line});
    const std::vector<CommentWord> value = words_of(stated->value);
    if (stated->label == "SPACING_UM" && value.size() == 1 && value[0].number)
        found.push_back({Mention::spacing, "um", *value[0].number, line});
}

std::size_t separators_at_end(std::string_view text) {
    return at(std::ranges::count_if(text.substr(text.find_last_not_of(" \t\r,;") + 1),
                                    [](char c) { return c == ',' || c == ';'; }));
}

// The blocks of lines with as many numbers each, between lines of text. Separators with which every
// line ends are no empty cells.
class ProfileBlocks {
public:
    ProfileBlocks(const std::string& path, bool missing) : path_(path), missing_(missing) {}

    void add(std::string_view text, long line) {
        std::vector<double> values;
        std::string_view cells = text.substr(0, text.find('#'));
        cells = cells.substr(std::min(cells.find_first_not_of(" \t\r"), cells.size()));
        if (cells.empty()) return;
        const std::size_t ends = separators_at_end(cells);
        if (block_.rows == 0) ends_ = ends;
        for (std::size_t k = 0; k < std::min(ends, ends_); ++k)
            cells = cells.substr(0, cells.find_last_of(",;"));
        Style style = block_.rows > 0 ? style_ : Style{};
        std::size_t count = 0;
        std::string why;
        try {
            const Row row = parse(cells, path_, line, style, missing_, values);
            count = row.count;
            if (missing_ && row.open_end && count + 1 == block_.columns) {
                values.push_back(std::nan(""));
                ++count;
            }
        } catch (const Error& error) {
            why = error.what();
        }
        if (count == 0 || (block_.rows > 0 && count != block_.columns)) {
            if (why.empty() && count > 0)
                why = joined(path_, ":", line, ": ", count, " values where ", block_.columns,
                             " as before were expected");
            close(why);
            if (count == 0) {
                heading_ = utf8(text);
                heading_line_ = line;
                find_sigmasurf(heading_, line, others_);
                return;
            }
        }
        if (block_.rows == 0) {
            block_.columns = count;
            if (heading_line_ > 0) find_column_units(heading_, heading_line_, count, block_.units);
        }
        style_ = style;
        block_.values.insert(block_.values.end(), values.begin(), values.end());
        block_.line.push_back(line);
        ++block_.rows;
    }
    void comment(std::string_view text, long line) { find_units(utf8(text), line, others_); }

    // The longest block. Another long one means that a line inside the profile is damaged.
    TextTable longest() {
        close("");
        constexpr std::size_t few = 8;
        if (second_ >= few)
            bad_input(path_,
                      ": numbers in two places; a profile was expected in one block of lines",
                      broken_.empty() ? "" : ": ", broken_);
        if (longest_.rows == 0) bad_input(path_, ": contains no numbers");
        longest_.units.insert(longest_.units.end(), others_.begin(), others_.end());
        return std::move(longest_);
    }

private:
    void close(const std::string& why) {
        if (block_.rows > 0 && !why.empty() && block_.rows > longest_.rows) broken_ = why;
        if (block_.rows > longest_.rows) std::swap(block_, longest_);
        second_ = std::max(second_, block_.rows);
        block_ = {};
    }

    const std::string& path_;
    bool missing_;
    TextTable block_, longest_;
    Style style_;
    std::size_t second_ = 0;  // rows of the second longest
    std::size_t ends_ = 0;    // separators at the end of its lines
    std::string heading_, broken_;
    long heading_line_ = 0;
    std::vector<Mention> others_;
};

}  // namespace

TextTable read_profile_table(const std::string& path, bool missing) {
    UnpackedFile file(path);
    ProfileBlocks blocks(path, missing);
    std::string text;
    for (long line = 1; next_line(file, text); ++line) {
        std::string_view view(text);
        if (line == 1) require_text(path, view);
        if (view.find('\0') != std::string_view::npos)
            refuse(path, line, "neither text nor a NetCDF file (there is a zero byte)");
        if (const std::size_t mark = view.find('#'); mark != std::string_view::npos)
            blocks.comment(view.substr(mark + 1), line);
        blocks.add(view, line);
    }
    return blocks.longest();
}

}  // namespace rsc
