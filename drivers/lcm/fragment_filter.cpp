#include "drivers/lcm/fragment_filter.h"

#include <linux/filter.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <string>

namespace barehand {
namespace {

// Offsets in a datagram as socket filters see it: the header of UDP, then that of an LCM fragment (all big endian).
constexpr std::uint32_t kMagic = 8, kMessageSize = 16, kFragmentOffset = 20;
constexpr std::uint32_t kFragmentMagic = 0x4c433033;  // "LC03"; other datagrams pass
constexpr std::uint32_t kAll = 0xffffffff;            // number of bytes of a datagram that passes

bool is_bound_udp_socket(int descriptor) {
  int type = 0;
  socklen_t size = sizeof(type);
  if (getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return false;
  sockaddr_in address{};
  size = sizeof(address);
  return getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) == 0 && address.sin_family == AF_INET &&
         address.sin_port != 0;
}

}  // namespace

void drop_damaged_fragments() {
  std::array<sock_filter, 8> steps = {{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kMagic),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kFragmentMagic, 0, 4),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kMessageSize),
      BPF_STMT(BPF_MISC | BPF_TAX, 0),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kFragmentOffset),
      BPF_JUMP(BPF_JMP | BPF_JGT | BPF_X, 0, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, kAll),
      BPF_STMT(BPF_RET | BPF_K, 0),
  }};
  const sock_fprog program{static_cast<unsigned short>(steps.size()), steps.data()};

  // liblcm does not tell its socket.
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const std::string name = entry.path().filename();
    int descriptor = -1;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (is_bound_udp_socket(descriptor))
      static_cast<void>(setsockopt(descriptor, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof(program)));
  }
}

}  // namespace barehand
