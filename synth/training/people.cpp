#include "synth/training/people.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace viaface {
namespace {

// mouthClose makes up for what the identity moves the lips apart or into each other: they meet at rest.
Person momo() { return {"momo", "a young man", "rms", {}, {}}; }

Person amara() {
    Person person{"amara", "a woman of about thirty", "slt", {}, {}};
    person.identity = {{"identity000", 1.1},  {"identity001", 0.1},  {"identity002", -1.4},
                       {"identity003", -0.3}, {"identity004", -0.2}, {"identity005", 0.8},
                       {"mouthClose", 0.009}, {"mouthSmile", 0.08}};
    person.looks.complexion = {
        .skin = {114, 82, 67}, .redness = 0.3f, .lips = {0.84f, 0.56f, 0.60f}, .freckles = 0, .beard = 0};
    person.looks.hair = {.colour = {17, 14, 14},
                         .thickness = 4.5f,
                         .flat_crown = 0.35f,
                         .oval = 1,
                         .fade_from = -5,
                         .fade_to = 6,
                         .full_at = 26,
                         .ragged = 0.35f,
                         .cover = 0.9f,
                         .knot = HairKnot{{0, 126, -192}, {33, 31, 27}}};
    person.looks.brows = {.half_width = 3.2f, .rise = 1.0f, .cover = 0.95f};
    person.looks.iris_inner = {98, 60, 34};
    person.looks.iris_outer = {60, 38, 24};
    person.looks.lash_line = 0.8f;
    person.looks.cloth = {140, 96, 44};
    return person;
}

Person edwin() {
    Person person{"edwin", "a man of about sixty-five", "awb", {}, {}};
    person.identity = {{"identity000", -0.4},  {"identity001", -0.6}, {"identity002", 1.5},
                       {"identity003", 0.2},   {"identity004", 0.3},  {"identity005", -0.8},
                       {"mouthClose", -0.009}, {"mouthSmile", 0.05}};
    person.looks.complexion = {.skin = {219, 178, 161},
                               .redness = 1.2f,
                               .lips = {0.84f, 0.56f, 0.54f},
                               .freckles = 0.4f,
                               .beard = 0.7f,
                               .shaven = {0.78f, 0.78f, 0.80f},
                               .age = 1};
    person.looks.hair = {.colour = {92, 88, 84},
                         .grey = 0.7f,
                         .thickness = 4.2f,
                         .flat_crown = 0.95f,
                         .forehead = 8,
                         .temples = 15,
                         .fade_to = 12,
                         .cover = 0.7f};
    person.looks.brows = {.half_width = 4.2f, .grey = 0.3f, .rise = -0.4f, .cover = 0.85f};
    person.looks.iris_inner = {116, 132, 142};
    person.looks.iris_outer = {78, 98, 116};
    person.looks.lash_line = 0.3f;
    person.looks.cloth = {62, 74, 66};
    return person;
}

Person sumi() {
    Person person{"sumi", "a woman of about forty-five", "slt", {}, {}};
    person.identity = {{"identity000", 1.0},   {"identity001", 1.3},  {"identity002", 0.3},
                       {"identity003", 0.1},   {"identity004", -1.3}, {"identity005", 0.8},
                       {"mouthClose", -0.011}, {"mouthSmile", 0.07}};
    person.looks.complexion = {.skin = {217, 172, 143},
                               .redness = 0.75f,
                               .lips = {0.82f, 0.42f, 0.43f},
                               .freckles = 0.3f,
                               .beard = 0,
                               .age = 0.3f};
    person.looks.hair = {.colour = {16, 14, 15},
                         .grey = 0.012f,
                         .thickness = 5.5f,
                         .flat_crown = 0.45f,
                         .oval = 1,
                         .fade_from = -4,
                         .fade_to = 6,
                         .full_at = 24,
                         .ragged = 0.35f,
                         .cover = 0.9f,
                         .knot = HairKnot{{0, 24, -198}, {38, 30, 26}}};
    person.looks.brows = {.half_width = 3.0f, .rise = 0.6f, .cover = 0.9f};
    person.looks.iris_inner = {84, 54, 34};
    person.looks.iris_outer = {52, 35, 24};
    person.looks.lash_line = 0.75f;
    person.looks.cloth = {58, 82, 92};
    return person;
}

}  // namespace

const std::vector<Person>& people() {
    static const std::vector<Person> all = {momo(), amara(), edwin(), sumi()};
    return all;
}

const Person& person_named(const std::string& name) {
    const auto found = std::ranges::find(people(), name, &Person::name);
    if (found != people().end()) return *found;
    std::string allowed;
    for (const Person& person : people()) allowed += (allowed.empty() ? "" : ", ") + person.name;
    throw InputError("person", name, allowed);
}

}  // namespace viaface
