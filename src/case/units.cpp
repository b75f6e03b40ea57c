#include "case/units.hpp"

#include <locale.h>
#include <udunits2.h>

#include "base/error.hpp"

namespace rsc {
namespace {

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;

// UDUNITS stores its status in a global variable, prints to stderr by default, and reads numbers by
// the locale. During the lifetime of an object of this class only one thread uses UDUNITS, nothing
// is printed, and the decimal mark is a point.
class Session {
public:
    Session() : lock_(mutex()), old_handler_(ut_set_error_message_handler(ut_ignore)) {
        if (c_locale() != locale_t{}) old_locale_ = uselocale(c_locale());
    }
    ~Session() {
        if (old_locale_ != locale_t{}) uselocale(old_locale_);
        ut_set_error_message_handler(old_handler_);
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    // The unit system, read once from UDUNITS's XML files. Never freed: another thread may use it
    // while the program ends.
    ut_system* system() {
        static ut_system* const units = ut_read_xml(nullptr);
        if (!units)
            bad_input(
                "the list of units of UDUNITS cannot be read; set the environment's "
                "UDUNITS2_XML_PATH to its udunits2.xml");
        return units;
    }

    Unit parse(const std::string& text) {
        Unit unit(ut_parse(system(), text.c_str(), UT_UTF8), ut_free);
        if (!unit)
            unit.reset(ut_parse(system(), text.c_str(),
                                UT_LATIN1));  // the micro sign of older instruments
        return unit;
    }

private:
    static std::mutex& mutex() {
        static std::mutex m;
        return m;
    }
    static locale_t c_locale() {
        static const locale_t c = newlocale(LC_NUMERIC_MASK, "C", locale_t{});
        return c;
    }
    std::lock_guard<std::mutex> lock_;
    ut_error_message_handler old_handler_;
    locale_t old_locale_{};
};

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t");
    return first == std::string::npos
               ? ""
               : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

// The factor from `from` to `to`; 0 if they measure different quantities or have different zeros.
double factor_between(const Unit& from, const Unit& to) {
    const std::unique_ptr<cv_converter, decltype(&cv_free)> converter(
        ut_get_converter(from.get(), to.get()), cv_free);
    if (!converter || cv_convert_double(converter.get(), 0.0) != 0) return 0;
    // Conversion factors are short decimal numbers; rounding to 15 digits removes the errors of
    // their products.
    return std::stod(format("%.14e", cv_convert_double(converter.get(), 1.0)));
}

// Name of a quantity, default unit, a unit that measures it, and examples.
struct Known {
    const char *name, *usual, *measure, *examples;
};
const Known& known(Quantity quantity) {
    static constexpr Known all[] = {{"length", "mm", "m", "'mm', 'um' or 'm'"},
                                    {"force", "N", "N", "'N', 'mN' or 'uN'"},
                                    {"time", "s", "s", "'s', 'ms' or 'hour'"}};
    return all[at(quantity)];
}

std::string problem_of(Session& session, const std::string& text, const Unit& unit,
                       Quantity quantity) {
    const Known& expected = known(quantity);
    const std::string of = std::string("a unit of ") + expected.name +
                           " as UDUNITS spells it is expected, such as " + expected.examples;
    if (!unit) return "'" + text + "' is no unit; " + of;
    if (factor_between(unit, session.parse(expected.measure)) == 0)
        return "'" + text + "' is no unit of " + expected.name + "; " + of;
    return {};
}

}  // namespace

std::string unit_problem(const std::string& text, Quantity quantity) {
    // Not parsed, so that the defaults work without the list of units.
    if (text.empty() || text == "1" || text == known(quantity).usual) return {};
    Session session;
    return problem_of(session, text, session.parse(trimmed(text)), quantity);
}

double length_factor(const std::string& from, const std::string& to, int power) {
    const std::string a = trimmed(from), b = trimmed(to);
    const auto number = [](const std::string& text) { return text.empty() || text == "1"; };
    if ((power == 1 && a == b) || (number(a) && number(b))) return 1;
    Session session;
    const Unit unit = session.parse(a), expected = session.parse(b);
    const auto require = [&](const std::string& text, const Unit& parsed) {
        if (const std::string wrong = problem_of(session, text, parsed, Quantity::length);
            !wrong.empty())
            bad_input(wrong);
    };
    if (power != 0) require(b, expected);  // 0: an angle or a pure number
    if (power == 1) require(a, unit);
    const Unit raised(ut_raise(expected.get(), power), ut_free);
    const double factor = unit && raised ? factor_between(unit, raised) : 0;
    if (factor == 0) bad_input("'", a, "' where a unit like (", b, ")", power, " is expected");
    return factor;
}

double unit_factor(const std::string& from, const std::string& to) {
    Session session;
    const Unit unit = session.parse(from), expected = session.parse(to);
    return unit && expected ? factor_between(unit, expected) : 0;
}

std::string unit_of(const std::string& length_unit, int length_power, const std::string& force_unit,
                    int force_power) {
    std::string text;
    const auto factor = [&text](const std::string& unit, int power) {
        if (power == 0 || unit.empty() || unit == "1") return;
        bool plain = true;
        for (char c : unit)
            plain = plain && (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' ||
                              static_cast<unsigned char>(c) >= 0x80);
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

}  // namespace rsc
