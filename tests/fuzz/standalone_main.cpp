// NAME_smoke SECONDS [SEED]   runs a fuzz target without libFuzzer, which g++ does not have: its mutator changes
// scripts
//                             that it has made before, chosen at random. The same seed gives the same scripts.
// NAME_smoke FILE             runs the script of a file.
#include <sanitizer/asan_interface.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed);
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using Input = std::vector<std::uint8_t>;
constexpr std::size_t kMaxBytes = 2000;
constexpr std::size_t kMaxKept = 200;

Input current;

void show_current() {
  std::fprintf(stderr, "--- the input was:\n%.*s\n---\n", static_cast<int>(current.size()),
               reinterpret_cast<const char*>(current.data()));
}

std::minstd_rand& bytes_engine() {
  static std::minstd_rand engine(1);
  return engine;
}

Input read(const char* file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

long fuzz(std::chrono::seconds duration, unsigned seed) {
  std::minstd_rand random(seed);
  std::vector<Input> kept(1);
  long count = 0;
  const auto end = std::chrono::steady_clock::now() + duration;
  while (std::chrono::steady_clock::now() < end) {
    current = kept[random() % kept.size()];
    const std::size_t size = current.size();
    current.resize(kMaxBytes);
    current.resize(LLVMFuzzerCustomMutator(current.data(), size, kMaxBytes, static_cast<unsigned>(random())));
    LLVMFuzzerTestOneInput(current.data(), current.size());
    ++count;
    if (kept.size() < kMaxKept)
      kept.push_back(current);
    else
      kept[random() % kMaxKept] = random() % 4 == 0 ? Input() : current;
  }
  return count;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size) {
  auto& random = bytes_engine();
  const std::size_t place = size == 0 ? 0 : random() % size;
  const auto byte = static_cast<std::uint8_t>(random());
  if (size > 0 && random() % 3 == 0) {
    std::copy(data + place + 1, data + size, data + place);
    return size - 1;
  }
  if (size < max_size && random() % 2 == 0) {
    std::copy_backward(data + place, data + size, data + size + 1);
    ++size;
  }
  if (size > 0) data[place] = byte;
  return size;
}

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  __sanitizer_set_death_callback(show_current);
  const std::string first = argv[1];
  if (first.find_first_not_of("0123456789") != std::string::npos) {
    current = read(argv[1]);
    return LLVMFuzzerTestOneInput(current.data(), current.size());
  }
  const long count =
      fuzz(std::chrono::seconds(std::stoi(first)), argc > 2 ? static_cast<unsigned>(std::stoul(argv[2])) : 1);
  std::printf("%ld scripts\n", count);
  return 0;
}
