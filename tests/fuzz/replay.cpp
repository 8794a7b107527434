// Replaces libFuzzer for compilers without it: runs the fuzz target once with every file of a corpus and with mutations
// of it.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

namespace fs = std::filesystem;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;
using Random = std::mt19937;

constexpr int kMutations = 100;  // of each file

std::size_t below(std::size_t end, Random& random) { return random() % std::max<std::size_t>(end, 1); }

/// Changes a few bytes; sometimes also truncates the input or repeats a part of it.
Bytes mutated(Bytes bytes, Random& random) {
  for (auto changes = 1 + below(4, random); changes > 0 && !bytes.empty(); --changes)
    bytes[below(bytes.size(), random)] = static_cast<std::uint8_t>(random());
  if (below(4, random) == 0) bytes.resize(below(bytes.size(), random));
  if (below(8, random) == 0) bytes.insert(bytes.end(), bytes.begin(), bytes.begin() + below(bytes.size(), random));
  return bytes;
}

/// Runs the target with a buffer of exactly the input's size, so that a sanitizer detects reads beyond its end.
void run(Bytes bytes) {
  bytes.shrink_to_fit();
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || !fs::is_directory(argv[1])) return std::fprintf(stderr, "usage: %s CORPUS\n", argv[0]), 2;
  std::vector<fs::path> files(fs::directory_iterator(argv[1]), {});
  std::sort(files.begin(), files.end());

  // Run every input, and random mutations of it.
  Random random(1);
  for (const fs::path& path : files) {
    std::printf("%s\n", path.c_str());  // after a crash, the last printed name is that of the input
    std::fflush(stdout);
    std::ifstream file(path, std::ios::binary);
    const Bytes bytes(std::istreambuf_iterator<char>(file), {});
    run(bytes);
    for (int i = 0; i < kMutations; ++i) run(mutated(bytes, random));
  }
  return files.empty() ? 1 : 0;
}
