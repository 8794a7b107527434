#pragma once

#include <cstdint>
#include <memory>

#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

// Scenes with people. The seed determines the bodies, the objects, all positions, the camera's tilt and all motion.

/// A person who faces the camera and moves one hand.
std::unique_ptr<Sequence> make_person(std::uint64_t seed);
/// A hand above a desk, seen from across the desk, opposite the person.
std::unique_ptr<Sequence> make_desk_work(std::uint64_t seed);
/// A hand above a desk, seen from the person's eyes.
std::unique_ptr<Sequence> make_egocentric(std::uint64_t seed);

// Scenes without a hand. The camera moves slowly.

/// A person as in make_person(), whose arms end in sleeves, hang down or are behind the back.
std::unique_ptr<Sequence> make_empty_person(std::uint64_t seed);
/// A desk as in make_desk_work(), without a person.
std::unique_ptr<Sequence> make_empty_desk(std::uint64_t seed);
/// One to three heads 0.5 to 1 m away.
std::unique_ptr<Sequence> make_faces(std::uint64_t seed);
/// Two feet, bare or in shoes, seen from above or from the front.
std::unique_ptr<Sequence> make_feet(std::uint64_t seed);

}  // namespace barehand::synthetic
