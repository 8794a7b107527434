// Prints the angles of the index finger from a running `barehand track`, frame by frame. Build it with
//   lcm-gen -x --cpp-hpath types /usr/share/barehand/lcmtypes/*.lcm
//   g++ -std=c++17 -isystem types angles.cpp -o angles $(pkg-config --cflags --libs lcm)
// (packages g++, liblcm-bin, liblcm-dev, pkg-config) and run it as ./angles [LINES]. LCM_DEFAULT_URL names the network.
#include <barehand/glove_state_t.hpp>
#include <barehand/hand_state_t.hpp>
#include <cstdio>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>

namespace {

constexpr double kDegrees = 57.29577951308232;  // degrees per radian
constexpr const char* kStatus[] = {"searching", "tracking", "holding", "lost"};

struct Printer {
  long lines = -1;  // number of lines still to be printed; negative: no limit

  void print(const lcm::ReceiveBuffer*, const std::string&, const barehand::glove_state_t* glove) {
    using barehand::glove_state_t;
    const bool left = glove->handedness == barehand::hand_state_t::LEFT;
    const bool known = glove->status >= 0 && glove->status < 4;
    std::printf("frame %lld %s %s", static_cast<long long>(glove->frame_number), left ? "left" : "right",
                known ? kStatus[glove->status] : "?");

    // Print the angles only if there is a pose: without one, every angle is NaN and flagged as unobservable.
    if (glove->channel_flag[glove_state_t::INDEX_MPJ] != glove_state_t::UNOBSERVABLE)
      for (const int channel : {glove_state_t::INDEX_MPJ, glove_state_t::INDEX_PIJ, glove_state_t::INDEX_DIJ})
        std::printf(" %.1f", glove->channel[channel] * kDegrees);
    std::printf("\n");
    std::fflush(stdout);
    if (lines > 0) --lines;
  }
};

}  // namespace

int main(int argc, char** argv) {
  lcm::LCM lcm;
  if (!lcm.good()) {
    std::fprintf(stderr, "cannot connect to LCM; is there a multicast route? sudo ip route add 224.0.0.0/4 dev lo\n");
    return 1;
  }
  Printer printer;
  if (argc > 1) printer.lines = std::atol(argv[1]);
  lcm.subscribe("GLOVE_STATE", &Printer::print, &printer);
  while (printer.lines != 0 && lcm.handle() == 0) {
  }
}
