// The built-in people: one blend-shape head in the shapes of its identity modes, each painted by looks of
// their own. None is a likeness of anyone.
#pragma once

#include <string>
#include <vector>

#include "synth/training/blend_head.hpp"
#include "synth/training/looks.hpp"

namespace viaface {

struct Person {
    std::string name, summary;
    std::string voice;      // of Flite, when a request names none
    ShapeWeights identity;  // of the head: its identity modes, and shapes that stay
    Looks looks;
};

const std::vector<Person>& people();                  // the first is momo, who has no identity of his own
const Person& person_named(const std::string& name);  // InputError("person", ...)

}  // namespace viaface
