#include "case/namelist.hpp"

namespace rsc::namelist {
namespace {

constexpr int kEnd = -1;

// Character classes that do not depend on the locale.
bool is_digit(int c) { return c >= '0' && c <= '9'; }
bool is_letter(int c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_name(int c) { return is_letter(c) || is_digit(c) || c == '_' || c == '%'; }
bool is_blank(int c) { return c == ' ' || c == '\t'; }
bool is_line_end(int c) { return c == '\n' || c == '\r'; }
// Characters that end a value; '!' begins a comment.
bool is_separator(int c) {
    return is_blank(c) || is_line_end(c) || c == ',' || c == ';' || c == '/' || c == '!' ||
           c == kEnd;
}

class Parser {
public:
    Parser(std::string_view text, const std::vector<std::string_view>& known)
        : text_(text), known_(known) {
        lines_.push_back(0);
        for (const auto i : indices(text))
            if (text[i] == '\n') lines_.push_back(i + 1);
    }

    // Text outside of groups is skipped unless it looks like a group or a key, and would be lost
    // without a word; a group inside a comment does not count.
    Document document() {
        std::size_t resumed = 0;  // where the last group ended
        bool lost = false;        // inside a group whose name is wrong, which is reported once
        for (int c = next(); c != kEnd; c = next()) {
            if (c == '!') skip_line();
            const std::size_t sign = at_ - 1;
            if (c == '=' && !lost && outside_key(sign)) skip_line();
            if (c != '&' && c != '$') continue;
            while (peek() != '%' && is_name(peek())) next();
            const std::string name = lower_case(text_.substr(sign + 1, at_ - sign - 1));
            const bool group_like = is_separator(peek()) && !name.empty();
            if (group_like && name == "end") {
                lost = false;
                continue;
            }
            if (!group_like || !contains(known_, name)) {
                // A dollar sign inside prose is a price.
                if (!lost && (c == '&' || (!name.empty() && first_on_line(sign, resumed))))
                    wrong_group(sign, name);
                lost = lost || group_like || first_on_line(sign, resumed);
                skip_line();
                continue;
            }
            lost = false;
            Group group{name, {}, position(sign)};
            complete_ = false;
            body(group);
            resumed = at_;
            document_.groups.push_back(std::move(group));
        }
        if (!document_.groups.empty() && outside_ < resumed) nothing_after(resumed);
        return std::move(document_);
    }

    Document assignments_alone() {
        Group group{"", {}, {}};
        alone_ = true;
        body(group);
        if (at_ < text_.size())
            fault(at_, "nothing may follow the value, found '", excerpt(at_), "'");
        document_.groups.push_back(std::move(group));
        return std::move(document_);
    }

private:
    // --- characters
    // at_eol_: the last character read, even if put back, ended a line. The separators below depend
    // on it.
    int next() {
        const int c = peek();
        if (c != kEnd) ++at_;
        at_eol_ = is_line_end(c) || c == kEnd;
        return c;
    }
    void back(int c) {
        if (c != kEnd) --at_;
    }
    int at(std::size_t offset) const {
        return offset < text_.size() ? static_cast<unsigned char>(text_[offset]) : kEnd;
    }
    int peek() const { return at(at_); }
    int skip_blanks() {
        int c = next();
        while (is_blank(c)) c = next();
        back(c);
        return c;
    }
    void skip_line() {
        int c = next();
        while (c != '\n' && c != kEnd) c = next();
    }

    Position position(std::size_t offset) const {
        const auto line = std::ranges::upper_bound(lines_, offset) - lines_.begin();
        return {int(line), int(offset - lines_[std::size_t(line - 1)] + 1)};
    }
    void fault(std::size_t offset, const auto&... text) {
        report(document_.faults, position(offset), text...);
    }
    void warn(std::size_t offset, const auto&... text) {
        report(document_.warnings, position(offset), text...);
    }
    void report(std::vector<Fault>& faults, Position at, const auto&... text) {
        if (faults.size() < kMostFaults) faults.emplace_back(at, context_, text...);
    }

    // The word at an offset, for a message.
    std::string excerpt(std::size_t offset) const {
        std::string word;
        while (offset < text_.size() && word.size() < 40 &&
               (word.empty() || !is_separator(text_[offset]))) {
            const char c = text_[offset++];
            word += static_cast<unsigned char>(c) < ' ' ? '?' : c;
        }
        return word;
    }

    // A group whose name is wrong: "&surfce", "& surface", "&surface%n=1", "&-surface".
    void wrong_group(std::size_t sign, const std::string& name) {
        const std::string word = excerpt(sign);
        outside_ = sign;
        if (is_separator(peek()) && !name.empty())
            fault(sign, "unknown group '&", name.substr(0, 63), "'", suggestion(name, known_, "&"));
        else
            fault(sign, "'", word, "' begins no group: expected '&' and straight after it the ",
                  "name of a group, then a blank or a new line; comments begin with '!'",
                  suggestion(name, known_, "&"));
    }

    // Reports "n = 128" outside of groups; false if no name stands before the '='.
    bool outside_key(std::size_t equals) {
        std::size_t end = equals;
        while (end > 0 && is_blank(text_[end - 1])) --end;
        std::size_t start = end;
        while (start > 0 &&
               (is_name(text_[start - 1]) || text_[start - 1] == ')' || text_[start - 1] == '('))
            --start;
        if (start == end || is_digit(text_[start])) return false;
        outside_ = start;
        fault(start, "'", text_.substr(start, std::min(end - start, std::size_t{63})),
              " =' stands outside a group and would be ignored: keys stand between ",
              "&name and '/', comments after '!'");
        return true;
    }

    static std::string shown(const Assignment& a) { return "'" + a.key.substr(0, 63) + "'"; }

    // A key behind the last '/' would be ignored without a message.
    void nothing_after(std::size_t offset) {
        for (std::size_t i = offset; i < text_.size(); ++i) {
            if (text_[i] == '!') i = text_.find('\n', i);
            if (i == std::string_view::npos) return;
            if (is_blank(text_[i]) || is_line_end(text_[i]) || text_[i] == '/') continue;
            if (lower_case(text_.substr(i, 4)) == "$end" ||
                lower_case(text_.substr(i, 4)) == "&end") {
                i += 3;
                continue;
            }
            if (text_[i] == '!' || text_[i] == '&' || text_[i] == '$')
                return;  // a comment to the end, or a group already reported
            fault(i, "'", excerpt(i),
                  "' after the last group would be ignored: write keys between &name and "
                  "'/', and comments after '!'");
            return;
        }
    }

    bool first_on_line(std::size_t offset, std::size_t resumed) const {
        while (offset > resumed && is_blank(text_[offset - 1])) --offset;
        return offset == resumed || text_[offset - 1] == '\n';
    }

    // --- separators, the way gfortran does them
    // After a value: blanks, then at most one comma, or the end of the line with all that is blank
    // or comment after it.
    void skip_separator() {
        skip_blanks();
        comma_ = false;
        int c = next();
        if (c == ',' || c == ';') {
            comma_ = true;
            skip_blanks();
        } else if (c == '/') {
            complete_ = true;
        } else if (c == '!') {
            skip_line();
        } else if (is_line_end(c)) {
            if (c == '\r' && peek() != '\n') {
                back(next());
                return;
            }
            do {
                c = next();
                if (c == '!') skip_line();
            } while (c == '!' || is_line_end(c) || is_blank(c));
            back(c);
        } else {
            back(c);
        }
    }
    // Before the next value, if the previous one ended its line: a comma counts only if none
    // preceded.
    void finish_separator() {
        for (;;) {
            int c = skip_blanks();
            if (c == kEnd) return;
            c = next();
            if (c == '/')
                complete_ = true;
            else if (c == '!') {
                skip_line();
                continue;
            } else if (is_line_end(c))
                continue;
            else if (c == ',' && !comma_) {
                c = skip_blanks();
                if (is_line_end(c)) continue;
            } else
                back(c);
            return;
        }
    }

    void skip_separators() {
        skip_separator();
        if (!complete_ && at_eol_) finish_separator();
    }

    // --- a group
    void body(Group& group) {
        context_ = alone_ ? "" : "&" + group.name + ": ";
        bool lost = false;  // a fault was reported and no valid assignment followed yet
        for (;;) {
            skip_separators();
            if (complete_) break;
            const std::size_t start = at_;
            const int c = next();
            if (c == kEnd) {
                if (!alone_)
                    report(document_.faults, group.at,
                           "the group is not closed by '/' before the end of the text");
                break;
            }
            if (c == '&' || c == '$') {
                const bool end = !alone_ && lower_case(text_.substr(at_, 3)) == "end";
                if (!end && !alone_)
                    fault(start, "the group is not closed by '/' before '", excerpt(start), "'");
                at_ = end ? at_ + 3 : start;
                break;
            }
            if (c == '?')
                continue;  // gfortran's query, which does nothing unless typed at a terminal
            if (c == '=' && peek() == '?') {
                next();
                continue;
            }
            if (c == '/') break;
            if (is_separator(c)) {
                if (c == '!') back(c);
                continue;
            }
            back(c);
            const std::size_t assigned = group.assignments.size();
            assignment(group, start, lost);
            lost = group.assignments.size() == assigned;
        }
        context_.clear();
    }

    // key[(subscript)] = values. On a fault nothing is added and reading continues after the word;
    // consecutive faults give one message.
    void assignment(Group& group, std::size_t start, bool quiet) {
        Assignment a;
        a.at = position(start);
        while (is_name(peek())) next();
        a.key = lower_case(text_.substr(start, at_ - start));
        std::string problem;
        if (a.key.empty() || is_digit(a.key[0])) {
            problem = "expected key = value, found '" + excerpt(start) + "'";
            next();
        } else if (peek() == '(') {
            problem = subscript(a);
        }
        if (problem.empty()) {
            const std::size_t after_name = at_;
            skip_separators();
            if (complete_ || next() != '=') {
                complete_ = false;
                at_ = after_name;
                problem = "'=' must follow " + shown(a);
                if (is_blank(peek()) && skip_blanks() == '(')
                    problem = "no blank may stand between " + shown(a) + " and its subscript";
                at_ = after_name;
            }
        }
        if (!problem.empty()) {
            if (!quiet) fault(start, problem);
            while (!is_separator(peek()) && peek() != '=') next();
            return;
        }
        values(a);
        group.assignments.push_back(std::move(a));
    }

    // One dimension, blanks allowed between its parts. Returns an error message.
    std::string subscript(Assignment& a) {
        const std::string of = "the subscript of '" + a.key + "' ";
        const std::string expected =
            of + "must be (first) or (first:last), found '" + excerpt(at_) + "'";
        const std::size_t close = text_.find_first_of(")\n", at_);
        if (close == std::string_view::npos || text_[close] != ')') return expected;
        std::string_view inside = text_.substr(at_ + 1, close - at_ - 1);
        Subscript s;
        s.at = position(at_);
        at_ = close + 1;
        if (inside.find(',') != std::string_view::npos) return "'" + a.key + "' has one dimension";
        const std::size_t colon = inside.find(':');
        s.section = colon != std::string_view::npos;
        const auto part = [&](std::string_view text, std::optional<long>& number) {
            while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
            while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
            number = to_integer(text);
            if (!number && !text.empty()) return expected;
            return number && std::abs(*number) > kLargestRepeat ? of + "is too large" : "";
        };
        std::string problem = part(inside.substr(0, colon), s.first);
        if (problem.empty() && s.section) problem = part(inside.substr(colon + 1), s.last);
        if (!problem.empty()) return problem;
        if (!s.section && !s.first) return of + "is empty";
        a.subscript = s;
        return {};
    }

    // --- values
    // Up to the next key, the end of the group or the end of the text.
    void values(Assignment& a) {
        // Offset of a null value for gfortran but not for the Fortran standard.
        std::size_t doubtful = std::string_view::npos;
        skip_blanks();
        bool after_line = false;
        for (;;) {
            if (at_eol_) finish_separator();
            if (complete_ || at_ >= text_.size()) return;
            const std::size_t start = at_;
            const int c = peek();
            if (c == '&' || c == '$' || c == '?' || c == '=') return;
            if (is_separator(c)) {
                if (c == '!' || (c == ',' && after_line)) doubtful = start;
                after_line = false;
                null_value(a, start);
                skip_separator();
                continue;
            }
            if (key_follows()) return;
            if (doubtful != std::string_view::npos) {
                warn(doubtful, "the value of ", shown(a),
                     " here is empty, as gfortran reads it: a comment straight after "
                     "'=' or ',', or a line that "
                     "begins with a comma, makes a null value");
                doubtful = std::string_view::npos;
            }
            if (!item(a, start)) return;
            after_line = passed_line_end(start);
        }
    }

    // True if the separator just skipped went over the end of a line and stopped at a comma.
    bool passed_line_end(std::size_t start) const {
        if (peek() != ',' || at_eol_) return false;
        std::size_t i = at_;
        while (i > start && (is_blank(text_[i - 1]) || text_[i - 1] == '\r')) --i;
        return i > start && text_[i - 1] == '\n';
    }

    void null_value(Assignment& a, std::size_t start) {
        if (!a.items.empty() && a.items.back().null && !a.items.back().counted) {
            ++a.items.back().repeat;
            return;
        }
        Item item;
        item.null = true;
        item.at = position(start);
        add(a, std::move(item));
    }

    void add(Assignment& a, Item item) {
        if (a.items.size() == kMostItems)
            report(document_.faults, item.at, "more than ", kMostItems, " values for ", shown(a));
        if (a.items.size() <= kMostItems) a.items.push_back(std::move(item));
    }

    // A value with its repeat count; false if the text ends within it.
    bool item(Assignment& a, std::size_t start) {
        Item item;
        item.at = position(start);
        repeat_count(item);
        const int c = peek();
        if (item.counted && is_separator(c)) {
            item.null = true;
            add(a, std::move(item));
            skip_separator();
            return true;
        }
        if (c == '"' || c == '\'') {
            if (!quoted(item)) {
                fault(start, "the text that begins here is not closed by ",
                      std::string(1, static_cast<char>(c)));
                return false;
            }
            if (!is_separator(peek())) fault(at_, "a blank or comma must follow the closing quote");
        } else {
            const std::size_t word = at_;
            while (!is_separator(peek())) ++at_;
            item.text = std::string(text_.substr(word, at_ - word));
            item.commented = peek() == '!';
            // After Infinity or NaN gfortran searches, also on later lines, for the '=' of a key
            // with that name.
            const bool named =
                item.text.find_first_of("iInN") != std::string::npos && to_real(item.text);
            if (named && (peek() == ' ' || is_line_end(peek())))
                while (peek() == ' ' || is_line_end(peek())) ++at_;
        }
        add(a, std::move(item));
        skip_separator();
        return true;
    }

    void repeat_count(Item& item) {
        std::size_t i = at_;
        while (is_digit(at(i))) ++i;
        if (i == at_ || at(i) != '*') return;
        const auto count = to_integer(text_.substr(at_, i - at_));  // empty if larger than 64 bits
        if (!count || *count > kLargestRepeat)
            fault(at_, "the repeat count is larger than ", kLargestRepeat);
        else if (*count == 0)
            fault(at_, "the repeat count is zero");
        else
            item.repeat = *count;
        item.counted = true;
        at_ = i + 1;
    }

    // Line ends within quotes are dropped, a doubled quote stands for one.
    bool quoted(Item& item) {
        item.quoted = true;
        const int quote = next();
        for (int c = next(); c != kEnd; c = next()) {
            if (c == quote) {
                if (peek() != quote) return true;
                next();
            }
            if (!is_line_end(c)) item.text += static_cast<char>(c);
        }
        return false;
    }

    // True if a key, with or without a subscript, and '=' follow.
    bool key_follows() const {
        std::size_t i = at_;
        if (!is_letter(at(i)) && at(i) != '_') return false;
        while (is_name(at(i))) ++i;
        if (at(i) == '(') {
            const std::size_t longest = i + 200;
            while (i < longest && at(i) != ')' && at(i) != '\n' && at(i) != kEnd) ++i;
            if (at(i) != ')') return false;
            ++i;
        }
        for (;; ++i) {
            if (at(i) == '!')
                while (at(i) != '\n' && at(i) != kEnd) ++i;
            if (!is_blank(at(i)) && !is_line_end(at(i))) return at(i) == '=' && at(i + 1) != '?';
        }
    }

    std::string_view text_;
    const std::vector<std::string_view>& known_;
    std::vector<std::size_t> lines_;  // offsets where lines begin
    std::size_t at_ = 0;
    bool at_eol_ = false, comma_ = false, complete_ = false;
    std::size_t outside_ = 0;  // place of the last fault outside of groups
    bool alone_ = false;       // assignments without a group around them
    std::string context_;      // "&group: " within a group
    Document document_;
};

}  // namespace

Document parse(std::string_view text, const std::vector<std::string_view>& known_groups) {
    return Parser(text, known_groups).document();
}

Document parse_assignments(std::string_view text) {
    const std::vector<std::string_view> none;
    return Parser(text, none).assignments_alone();
}

std::string format(const std::string& name, const Fault& fault) {
    if (fault.at.line == 0) return name + ": " + fault.text;
    return joined(name, ":", fault.at.line, ":", fault.at.column, ": ", fault.text);
}

}  // namespace rsc::namelist
