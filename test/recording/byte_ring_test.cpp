#include "interpolated_motion_driver/recording/byte_ring.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace interpolated_motion::recording {
namespace {

HostTime at(int milliseconds) { return HostTime{std::chrono::milliseconds(milliseconds)}; }

void push(ByteRing& ring, int milliseconds, const std::string& text) {
  ring.push({at(milliseconds), static_cast<std::uint32_t>(text.size()), EntryKind::Note}, text.data());
}

std::vector<std::string> texts(const ByteRing& ring) {
  std::vector<std::string> all;
  for_each_entry(ring.copy(), [&all](const EntryHead& head, const std::byte* bytes) {
    all.emplace_back(reinterpret_cast<const char*>(bytes), head.size);
  });
  return all;
}

TEST(ByteRing, GivesBackWhatWasPutIn) {
  ByteRing ring(1000);
  push(ring, 1, "one");
  push(ring, 2, "");
  push(ring, 3, "three");
  EXPECT_EQ(texts(ring), (std::vector<std::string>{"one", "", "three"}));
  EXPECT_EQ(ring.displaced(), 0U);
}

// Entries of all lengths come to lie across the end of the memory.
TEST(ByteRing, KeepsTheNewestWhole) {
  ByteRing ring(301);
  std::vector<std::string> pushed;
  for (int i = 0; i < 500; ++i) {
    pushed.push_back(std::to_string(i) + std::string(static_cast<std::size_t>(i % 23), 'x'));
    push(ring, i, pushed.back());
    ASSERT_LE(ring.used(), 301U);
    const auto kept = texts(ring);
    ASSERT_FALSE(kept.empty());
    ASSERT_EQ(kept, std::vector<std::string>(pushed.end() - static_cast<std::ptrdiff_t>(kept.size()),
                                             pushed.end()));
    ASSERT_EQ(ring.displaced() + kept.size(), pushed.size());
  }
}

TEST(ByteRing, ForgetsWhatIsOlder) {
  ByteRing ring(1000);
  for (int i = 0; i < 5; ++i) push(ring, i, std::to_string(i));
  ring.forget_before(at(3));
  EXPECT_EQ(texts(ring), (std::vector<std::string>{"3", "4"}));
  EXPECT_EQ(ring.forgotten(), 3U);
}

TEST(ByteRing, LeavesOutWhatIsTooLargeForAllOfIt) {
  ByteRing ring(100);
  push(ring, 1, "one");
  push(ring, 2, std::string(100, 'x'));
  EXPECT_EQ(texts(ring), std::vector<std::string>{"one"});
  EXPECT_EQ(ring.displaced(), 1U);
}

}  // namespace
}  // namespace interpolated_motion::recording
