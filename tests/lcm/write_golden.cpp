// Writes tests/golden/lcm/*.bin. Run it only for a new type: if a file changes, old logs cannot be read any more.
#include <fstream>
#include <iostream>
#include <string>

#include "drivers/lcm/wire.h"
#include "golden_messages.h"

namespace {

template <class Message>
void write(const std::string& directory, const Message& message) {
  const auto bytes = barehand::encode_message(message);
  std::ofstream file(directory + "/" + Message::getTypeName() + ".bin", std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_golden_messages DIRECTORY\n";
    return 2;
  }
  using namespace barehand::golden;
  write(argv[1], rgbd_frame());
  write(argv[1], hand_state());
  write(argv[1], glove_state());
  write(argv[1], hand_joints());
  write(argv[1], contact_state());
  write(argv[1], grasp_state());
  write(argv[1], object_state());
  write(argv[1], health());
  write(argv[1], command());
}
