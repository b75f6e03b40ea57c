// Random namelist inputs over the keys of the registry: every syntax of the standard, gfortran's extensions, and damaged text.
#pragma once

#include <algorithm>
#include <cctype>
#include <random>
#include <string>
#include <vector>

#include "case/namelist.hpp"
#include "case/namelist_value.hpp"
#include "case/registry.hpp"

class CaseMaker {
public:
    explicit CaseMaker(unsigned seed) : engine_(seed) {}

    // Up to four groups with text around them. Ends with blank lines: gfortran calls a group that closes on the last line of a
    // file, with no line end after it, the end of the file.
    std::string well_formed() {
        std::string text;
        std::vector<std::string> groups;
        for (const std::string_view group : rsc::group_names())
            if (group != "study") groups.emplace_back(group);
        shuffle(groups);
        groups.resize(static_cast<std::size_t>(number(1, 4)));
        for (const std::string& group : groups) {
            text += pick({"", "", "\n", "a title, or a remark\n", "! &" + group + " in a comment = 3 /\n", "3.5 / 'text'\n", "\t "});
            text += some_group(group);
        }
        return text + "\n\n";
    }

    // The same with a few characters changed, inserted or lost.
    std::string damaged() {
        std::string text = well_formed();
        for (int k = number(1, 3); k > 0; --k) {
            const auto at = static_cast<std::size_t>(number(0, static_cast<int>(text.size()) - 1));
            const std::string piece =
                pick({" ", ",", "\n", "'", "\"", "=", "(", ")", "*", "!", "3", "e", "-", ".", ":", "t", "x", "\t", "%", "1*", "+"});
            switch (number(0, 2)) {
                case 0: text.insert(at, piece); break;
                case 1: text.erase(at, 1); break;
                default: text.replace(at, 1, piece);
            }
        }
        return text + "\n\n";
    }

private:
    // Not the library's distribution: the inputs of a seed are the same everywhere.
    int number(int low, int high) { return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1)); }
    template <class T>
    void shuffle(std::vector<T>& items) {
        for (std::size_t i = items.size(); i > 1; --i)
            std::swap(items[i - 1], items[static_cast<std::size_t>(number(0, static_cast<int>(i) - 1))]);
    }
    bool chance(int percent) { return number(1, 100) <= percent; }
    std::string pick(const std::vector<std::string>& from) {
        return from[static_cast<std::size_t>(number(0, static_cast<int>(from.size()) - 1))];
    }

    std::string any_case(std::string word) {
        const int style = number(0, 3);
        for (char& c : word) {
            if (style == 1 || (style == 2 && chance(50))) c = static_cast<char>(std::toupper(c));
            if (style == 3) c = static_cast<char>(std::tolower(c));
        }
        return word;
    }

    std::string blanks() { return pick({"", "", " ", " ", "  ", "\t"}); }

    std::string some_group(const std::string& group) {
        std::string text =
            pick({"&", "&", "&", "$"}) + any_case(group) + pick({" ", "\n", "\t", "  ! a remark\n", "\n\n  ", ", ", "\r\n", "!\n"});
        std::vector<const rsc::Key*> keys;
        for (const rsc::Key& key : rsc::registry())
            if (group == key.group) keys.push_back(&key);
        shuffle(keys);
        keys.resize(std::min(keys.size(), static_cast<std::size_t>(number(0, 6))));
        for (const rsc::Key* key : keys) {
            text += assignment(*key);
            text += pick({" ", ",", ", ", "\n", ",\n  ", " , ", "\n\n", " ! a remark\n", "; ", "\t", "\r\n", ", ! a 'remark' &run\n",
                          "\n! a line\n  "});
            if (chance(2)) text += pick({"? ", "=? ", ",, "});
        }
        return text + pick({"/", "/", "\n/", " / text after it", "&end", "&END", "$end", "/!"}) + pick({"\n", " \n", "\n\n"});
    }

    std::string assignment(const rsc::Key& key) {
        const std::string equals = pick({"=", "=", " = ", "= ", " =", "\n = ", "  =\n ", "\t=\t", " ! a remark\n  = "});
        if (key.type == rsc::Type::string || key.type == rsc::Type::choice) {
            std::string part;
            std::string text = key.type == rsc::Type::choice
                                   ? key.choices[static_cast<std::size_t>(number(0, static_cast<int>(key.choices.size()) - 1))]
                                   : words();
            if (key.type == rsc::Type::string && chance(15))
                part = pick({"(1:3)", "(2:)", "(:5)", "(4:4)", "( 2:6)", "(3:5:1)", "(1:70)", "(3:2)", "(2)", "(0:2)"});
            if (part.empty() && chance(3)) return any_case(key.name) + equals + pick({"", "1*", ","});
            std::string repeat = chance(5) ? "1*" : "";
            if (key.type == rsc::Type::string && part.empty() && chance(4))
                return any_case(key.name) + equals + pick({"12", "1*abc", "2b-c", "7.5e3"});
            return any_case(key.name) + part + equals + repeat + quoted(text);
        }
        const int size = std::min(key.size, 12);
        std::string name = any_case(key.name);
        int room = size;
        if (key.size > 1 && chance(40)) {
            if (key.size == 2) {
                const int form = number(0, 7);
                name += std::vector<std::string>{
                    "(1)", "(2)", "(1:2)", "(2:1:-1)", "(:)", "(2:)", "( 1 )", "(+2:2)"}[static_cast<std::size_t>(form)];
                room = std::vector<int>{2, 1, 2, 2, 2, 1, 2, 1}[static_cast<std::size_t>(form)];
            } else {
                const int form = number(0, 5);
                name += std::vector<std::string>{"(1:4)", "(1:5:2)", "(4:1:-1)", "(:3)", "(1)", "(3:1:-2)"}[static_cast<std::size_t>(form)];
                room = std::vector<int>{4, 3, 4, 3, 9, 2}[static_cast<std::size_t>(form)];
            }
            if (chance(4)) name += "(1)";
            if (chance(3)) room += 1;
        } else if (chance(2)) {
            room += 1;
        }
        return name + equals + values(key, number(room > 2 ? 1 : room, room));
    }

    std::string values(const rsc::Key& key, int room) {
        std::string text;
        bool first = true;
        while (room > 0) {
            if (!first) text += pick({",", ", ", " ", " , ", "\n", ",\n", "; ", "  ", "\t", ",\t", " ! a remark\n ", ",\r\n", "\r\n"});
            first = false;
            if (chance(6)) {
                text += pick({"", ",", "1*", room > 1 ? "2*" : ""});
                if (chance(50)) text += ",";
                --room;
                continue;
            }
            int repeat = 1;
            if (chance(12)) {
                repeat = chance(90) ? number(1, room) : number(0, room + 1);
                text += std::to_string(repeat) + "*";
            }
            text += value(key.type);
            room -= std::max(repeat, 1);
        }
        return text;
    }

    std::string value(rsc::Type type) {
        if (type == rsc::Type::logical)
            return pick({"t", "T", "f", "F", ".true.", ".FALSE.", ".t.", ".F", "true", "False", ".t", "tfoo", ".fals", "t(3)", "truth", "0",
                         "yes"});
        if (type == rsc::Type::integer || type == rsc::Type::long_integer) {
            if (chance(5))
                return pick({"1.5", "1e3", "2147483648", "-2147483648", "-2147483649", "9223372036854775807", "9223372036854775808", "3a",
                             "- 5", "+", "'3'", "0x1F"});
            return pick({"", "+", "-", "00"}) + std::to_string(number(0, chance(50) ? 100 : 2000000000));
        }
        if (chance(8)) return pick({"inf", "Infinity", "+INF", "-infinity", "nan", "NaN(q12)", "nan()", "-nan", "+nan"});
        if (chance(4))
            return pick(
                {".", "1e", "e5", ".e5", "1.2.3", "1e5.", "1.5f3", "--1", "infinit", "nan(a", "'1.5'", "1.0_8", "0x1p3", "1,5", "+.", "t"});
        if (chance(8))
            return pick({"1e999", "-1d400", "1e-999", "4.9e-324", "2.4e-324", "1.7976931348623157e308", "1e-310",
                         "0.1e-99999999999999999999", "-0.0", "0e999999999999"});
        std::string digits = pick({"", "+", "-"}) + std::to_string(number(0, chance(50) ? 20 : 999999999));
        if (chance(70))
            digits += "." + (chance(85) ? std::to_string(number(0, 999999999)) : "");
        else if (chance(10))
            digits = "." + std::to_string(number(0, 99999));
        if (chance(40)) digits += pick({"e", "E", "d", "D", "q", "Q", "e+", "d-", "E-", "Q+", "+", "-"}) + std::to_string(number(0, 30));
        return digits;
    }

    std::string words() {
        std::string text;
        for (int k = number(0, 4); k > 0; --k)
            text +=
                pick({"rough", " sphere", "/path/of.nc", " ", "it's", "\"", "''", "a=b", "! no remark", ", ", "(1)", "1*", "\\n", "\t"});
        return text;
    }

    // In either quote, now and then going on over the end of a line.
    std::string quoted(const std::string& text) {
        const char quote = chance(60) ? '\'' : '"';
        std::string result(1, quote);
        for (const char c : text) {
            result += c;
            if (c == quote)
                result += c;
            else if (chance(2))
                result += pick({"\n", "\r\n"});
        }
        return result + quote;
    }

    std::mt19937 engine_;
};
