#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

// fuzzers.inc: IMD_FUZZER(name) for each, as cmake/fuzz.cmake writes it.
#define IMD_FUZZER(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
#include "fuzzers.inc"
#undef IMD_FUZZER

namespace interpolated_motion {
namespace {

namespace fs = std::filesystem;
using Fuzzer = int (*)(const std::uint8_t*, std::size_t);

/// Gives a fuzzer one of its seeds: it throws, or does not return, where something is wrong.
class Seed : public testing::Test {
 public:
  Seed(Fuzzer fuzzer, fs::path file) : fuzzer_(fuzzer), file_(std::move(file)) {}

  void TestBody() override {
    std::ifstream stream(file_, std::ios::binary);
    ASSERT_TRUE(stream.good()) << file_;
    const std::string content{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_EQ(fuzzer_(reinterpret_cast<const std::uint8_t*>(content.data()), content.size()), 0);
  }

 private:
  Fuzzer fuzzer_;
  fs::path file_;
};

fs::path folder_of(const std::string& name) { return fs::path(IMD_SOURCE_DIR) / "test/fuzz/seeds" / name; }

std::vector<fs::path> seeds_of(const std::string& name) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder_of(name), none)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void register_seeds(const std::string& name, Fuzzer fuzzer) {
  for (const fs::path& file : seeds_of(name)) {
    testing::RegisterTest(name.c_str(), file.filename().c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [fuzzer, file]() -> Seed* { return new Seed(fuzzer, file); });
  }
}

/// A fuzzer without seeds, which nobody runs here, is a mistake.
TEST(Seeds, EveryFuzzerHasSome) {
#define IMD_FUZZER(name) EXPECT_FALSE(seeds_of(#name).empty()) << #name;
#include "fuzzers.inc"
#undef IMD_FUZZER
}

TEST(Seeds, EveryFolderHasItsFuzzer) {
  std::vector<std::string> fuzzers;
#define IMD_FUZZER(name) fuzzers.emplace_back(#name);
#include "fuzzers.inc"
#undef IMD_FUZZER
  for (const auto& entry : fs::directory_iterator(folder_of(""))) {
    const std::string name = entry.path().filename();
    EXPECT_EQ(std::count(fuzzers.begin(), fuzzers.end(), name), 1) << name;
  }
}

}  // namespace
}  // namespace interpolated_motion

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
#define IMD_FUZZER(name) interpolated_motion::register_seeds(#name, fuzz_##name);
#include "fuzzers.inc"
#undef IMD_FUZZER
  return RUN_ALL_TESTS();
}
