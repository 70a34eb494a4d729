// Makes MJCF bodies of objects.
#pragma once

#include <filesystem>
#include <span>

#include "mjcf/document.h"
#include "mjcf/mujoco_handles.h"
#include "objects/object_kinds.h"

namespace understudy::objects {

// Whether what is printed on objects is made, as shapes that nothing meets.
enum class Prints { kLeftOut, kKept };

// Returns a <worldbody> with a body for each object, by its name (NamesOf), in its place. Its
// origin is half its height above the middle of its underside; what moves has a free joint. What
// walks is where it begins. Every attribute in which the defaults of a robot's file could show is
// given.
mjcf::MjcfElement MakeObjectBodies(std::span<const ObjectSpec> objects, Prints prints);

// Throws ModelError with the key of the first picture that is no PNG; whether it is whole only who
// draws it finds out.
void RequirePictures(std::span<const ObjectSpec> objects);

// Returns an <asset> with the pictures of posters. Without children if there are none.
mjcf::MjcfElement MakePictures(std::span<const ObjectSpec> objects);

// Returns a <contact> by which what walks meets robots and what moves freely alone: neither the
// ground nor what is fixed nor what walks too, which none of them would give way to. Without
// children if nothing walks.
mjcf::MjcfElement MakeExclusions(std::span<const ObjectSpec> objects);

// Throws ModelError with the key of the first object that has the name of a body of `model`, which
// was compiled from `file`.
void RequireOwnNames(std::span<const ObjectSpec> objects, const mjModel& model,
                     const std::filesystem::path& file);

}  // namespace understudy::objects
