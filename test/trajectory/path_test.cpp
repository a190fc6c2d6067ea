#include "interpolated_motion_driver/trajectory/path.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace interpolated_motion::trajectory {
namespace {

Piece piece(double start, double end, double position, double velocity) {
  return {GoalTime(start), GoalTime(end), Polynomial{{position, velocity, 0, 0, 0, 0}}};
}

/// 1 -> 3 in [1, 2], 3 -> 2 in [2, 4].
Path two_pieces() { return Path({piece(1, 2, 1, 2), piece(2, 4, 3, -0.5)}); }

TEST(Path, RestsForEverWithoutPieces) {
  const Path path(0.7);
  EXPECT_TRUE(path.empty());
  EXPECT_EQ(path.final_position(), 0.7);
  EXPECT_EQ(path.sample(GoalTime(12)).position, 0.7);
  EXPECT_EQ(path.sample(GoalTime(12)).velocity, 0.0);
}

TEST(Path, SamplesThePieceThatBeginsAtAKnot) {
  const Path path = two_pieces();
  EXPECT_EQ(path.sample(GoalTime(1.5)).position, 2.0);
  EXPECT_EQ(path.sample(GoalTime(1.5)).velocity, 2.0);
  EXPECT_EQ(path.sample(GoalTime(2)).velocity, -0.5);
  EXPECT_EQ(path.sample(GoalTime(4)).position, 2.0);
  EXPECT_EQ(path.sample(GoalTime(4)).velocity, -0.5);
}

TEST(Path, RestsBeforeAndAfter) {
  const Path path = two_pieces();
  EXPECT_EQ(path.sample(GoalTime(0)).position, 1.0);
  EXPECT_EQ(path.sample(GoalTime(0)).velocity, 0.0);
  EXPECT_EQ(path.sample(GoalTime(5)).position, 2.0);
  EXPECT_EQ(path.sample(GoalTime(5)).velocity, 0.0);
  EXPECT_EQ(path.final_position(), 2.0);
}

TEST(Path, FindsThePieceFromAnyHint) {
  std::vector<Piece> pieces;
  pieces.reserve(20);
  for (int i = 0; i < 20; ++i) pieces.push_back(piece(i, i + 1, 0, 0));
  const Path path(pieces);
  for (std::size_t hint = 0; hint < 25; ++hint) {
    for (int i = 0; i < 20; ++i) {
      EXPECT_EQ(path.piece_index(GoalTime(i), hint), static_cast<std::size_t>(i));
      EXPECT_EQ(path.piece_index(GoalTime(i + 0.99), hint), static_cast<std::size_t>(i));
    }
    EXPECT_EQ(path.piece_index(GoalTime(20), hint), 19u);
  }
}

TEST(Path, RefusesPiecesThatAreNoPath) {
  EXPECT_THROW(Path(std::vector<Piece>{}), std::invalid_argument);
  EXPECT_THROW(Path({piece(1, 1, 0, 0)}), std::invalid_argument);
  EXPECT_THROW(Path({piece(1, 0, 0, 0)}), std::invalid_argument);
  EXPECT_THROW(Path({piece(0, 1, 0, 0), piece(1.5, 2, 0, 0)}), std::invalid_argument);
  EXPECT_THROW(Path({piece(0, 1, 0, 0), piece(0.5, 2, 0, 0)}), std::invalid_argument);
}

}  // namespace
}  // namespace interpolated_motion::trajectory
