// The rows of the physics (physics/physics.hpp): what they name exists.
#include "case/registry.hpp"
#include "check.hpp"
#include "physics/physics.hpp"

namespace test_rows {

using namespace rsc;

TEST(rows_of_physics) {
    std::set<std::string> names;
    for (const Physics* p : all_physics()) CHECK(names.insert(p->name).second);
    CHECK(physics_asked(Case{}).empty() && physics_asked(BodyPhysics{}).empty());
    for (const Physics* p : all_physics()) {
        CHECK(full_name(key_of(p->key)) == p->key);
        CHECK(p->keys && p->take && p->asked);
        for (const Key& key : p->keys()) CHECK(find_key(key.group, key.name));
        for (const Exclusion& x : p->excludes) {
            // A key, or a physics by its name.
            const bool key = std::string_view(x.other).find('%') != std::string_view::npos;
            CHECK(key ? x.when && full_name(key_of(x.other)) == x.other : names.contains(x.other));
            CHECK(!x.key || full_name(key_of(x.key)) == x.key);
        }
        for (const LevelQuantity& q : p->quantities)
            CHECK(std::ranges::count(level_quantities(), std::string_view(q.name),
                                     &LevelQuantity::name) == 1);
        CHECK(p->recorder || (p->curves.empty() && p->fields.empty()));
        CHECK(p->axis || p->curves.empty());
        for (const LevelCurve& c : p->curves)
            CHECK(c.error.empty() ||
                  std::ranges::count(p->curves, c.error, &LevelCurve::name) == 1);
        for (const PointField& f : p->fields)
            CHECK(contains(field_names(), std::string_view(f.name)));
    }
}

}  // namespace test_rows
