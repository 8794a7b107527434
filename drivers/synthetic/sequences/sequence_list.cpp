// The list of all sequences, and their creation by name.
#include "drivers/synthetic/grasps/varied_grasp.h"
#include "drivers/synthetic/people/people_sequences.h"
#include "drivers/synthetic/rendering/stage_set.h"

namespace barehand::synthetic {
namespace {

std::string known_names() {
  std::string names;
  for (const SequenceInfo& info : sequence_list()) names += (names.empty() ? "" : ", ") + info.name;
  return names;
}

std::vector<SequenceInfo> make_list() {
  std::vector<SequenceInfo> list = {
      {"fist", "two fists, from joined and from spread fingers (paper Fig. 6a)", 160, 25}};
  for (int degree = 0; degree <= 6; ++degree)
    list.push_back({"occlusion_" + std::to_string(degree),
                    "fingers spread and rejoin, " + std::to_string(degree) + "/6 of them behind a plate (Fig. 6b, c)",
                    45, 25});

  // Add the grasps.
  list.push_back({"grasp_mug", "reaches for a mug, lifts, turns, lowers and releases it", 200, 30});
  list.push_back({"grasp_ball", "the same with a 65 mm ball", 200, 30});
  list.push_back({"grasp_pliers", "the same with pliers", 200, 30});

  list.push_back({"grasp", "any grasp of any object: keys object and grasp, or drawn by the seed", 160, 30});

  // Add the motions of hands in the air.
  list.push_back({"wave", "a hand waves, leaves the view and comes back", 240, 30});
  list.push_back({"returns", "a hand leaves the view again and again and comes back elsewhere", 1125, 30});
  list.push_back({"open", "an open hand turns slowly", 180, 30});
  list.push_back({"scan", "a hand is shown from all sides and bent, for barehand calibrate", 900, 30});
  list.push_back({"two_hands", "a right and a left hand pass each other, meet as fists, leave and come back", 408, 30,
                  ShownHands::both});

  // Add the scenes with people, and those without any hand.
  list.push_back({"person", "a person before the camera, one of whose hands moves and bends", 180, 30});
  list.push_back({"desk", "a hand works above a desk with clutter; its owner sits at the far side", 180, 30});
  list.push_back({"egocentric", "the same as its owner sees it, from the eyes", 180, 30});
  list.push_back({"empty_person", "a person of whom no hand is seen", 200, 10, ShownHands::none});
  list.push_back({"empty_desk", "a desk with clutter and nobody", 200, 10, ShownHands::none});
  list.push_back({"faces", "heads near the camera", 200, 10, ShownHands::none});
  list.push_back({"feet", "bare feet or shoes", 200, 10, ShownHands::none});
  return list;
}

}  // namespace

const std::vector<SequenceInfo>& sequence_list() {
  static const std::vector<SequenceInfo> kList = make_list();
  return kList;
}

Result<SequenceInfo> sequence_info(const std::string& name) {
  for (const SequenceInfo& info : sequence_list())
    if (info.name == name) return info;
  return fail("there is no sequence \"" + name + "\"", "sim", "choose one of: " + known_names());
}

Result<std::unique_ptr<Sequence>> make_sequence(const std::string& name, const HandRig* rig, std::uint64_t seed,
                                                const GraspChoice& choice) {
  // The first sequences show free hands.
  if (name == "fist") return make_fist(seed);
  if (name == "open") return make_open(seed);
  if (name == "scan") return make_scan(seed);
  if (name == "wave") return make_wave(seed);
  if (name == "returns") return make_returns(seed);
  if (name == "two_hands") return make_two_hands(seed);

  // These sequences grasp objects.
  if (name == "grasp_mug") return make_grasp(*rig, GraspedShape::mug, seed);
  if (name == "grasp_ball") return make_grasp(*rig, GraspedShape::ball, seed);
  if (name == "grasp_pliers") return make_grasp(*rig, GraspedShape::pliers, seed);
  if (name == "grasp") return make_varied_grasp(*rig, choice, seed);

  // These sequences show people, with hands or without.
  if (name == "person") return make_person(seed);
  if (name == "desk") return make_desk_work(seed);
  if (name == "egocentric") return make_egocentric(seed);
  if (name == "empty_person") return make_empty_person(seed);
  if (name == "empty_desk") return make_empty_desk(seed);
  if (name == "faces") return make_faces(seed);
  if (name == "feet") return make_feet(seed);

  // The sequences of occlusion differ in its degree.
  for (int degree = 0; degree <= 6; ++degree)
    if (name == "occlusion_" + std::to_string(degree)) return make_occlusion(*rig, degree, seed);
  return tl::unexpected(sequence_info(name).error());
}

}  // namespace barehand::synthetic
