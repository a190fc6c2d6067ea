#include "interpolated_motion_driver/command_line/option_set.h"
#include "interpolated_motion_driver/units/closest_name.h"

#include <limits>
#include <stdexcept>

#include <optional>

#include <gtest/gtest.h>

namespace interpolated_motion::command_line {
namespace {

/// A program's options and what they were before they were given.
class OptionSetTest : public testing::Test {
 protected:
  OptionSetTest() {
    options_.add_text({"goal", "FILE", "a file (default: none)"}, text_);
    options_.add_number({"timeout", "SECONDS", "s (default: 3)"}, {-5.0, 5.0}, number_);
    options_.add_whole_number({"bitrate", "BIT/S", "bit/s"}, {0.0, 1e6}, whole_);
    options_.add_numbers({"clock-error-ppm", "PPM", "of each"}, {-100.0, 100.0}, numbers_);
    options_.add_switch("each", "tells of each", switch_);
    options_.add_whole_numbers({"epos", "NODES", "node ids"}, {1.0, 127.0}, wholes_);
  }

  bool parse(const std::vector<std::string>& arguments) const { return options_.parse(arguments); }

  std::string refusal(const std::vector<std::string>& arguments) const {
    try {
      options_.parse(arguments);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }

  OptionSet options_{"program --goal FILE\n", "Exit code: 0.\n"};
  std::string text_ = "before";
  double number_ = 3.0;
  int whole_ = 7;
  bool switch_ = false;
  std::vector<double> numbers_;
  std::vector<int> wholes_;
};

TEST_F(OptionSetTest, NothingGivenKeepsTheDefaults) {
  EXPECT_TRUE(parse({}));
  EXPECT_EQ(text_, "before");
  EXPECT_EQ(number_, 3.0);
  EXPECT_EQ(whole_, 7);
}

TEST_F(OptionSetTest, ASwitchHasNoValue) {
  EXPECT_TRUE(parse({}));
  EXPECT_FALSE(switch_);
  EXPECT_TRUE(parse({"--each", "--bitrate", "8"}));
  EXPECT_TRUE(switch_);
  EXPECT_EQ(whole_, 8);
  EXPECT_NE(refusal({"--each=1"}), "accepted");
  EXPECT_NE(refusal({"--each", "1"}), "accepted");
}

TEST_F(OptionSetTest, ValuesFollowABlankOrAnEqualsSign) {
  EXPECT_TRUE(parse({"--goal", "a b.yaml", "--timeout=1.5", "--bitrate", "125000", "--epos=1,2,127"}));
  EXPECT_EQ(text_, "a b.yaml");
  EXPECT_EQ(number_, 1.5);
  EXPECT_EQ(whole_, 125000);
  EXPECT_EQ(wholes_, (std::vector<int>{1, 2, 127}));
}

TEST_F(OptionSetTest, NegativeNumbersAreValues) {
  EXPECT_TRUE(parse({"--timeout", "-1", "--clock-error-ppm", "-20,3e1,-.5"}));
  EXPECT_EQ(number_, -1.0);
  EXPECT_EQ(numbers_, (std::vector<double>{-20.0, 30.0, -0.5}));
  EXPECT_TRUE(parse({"--timeout=-2"}));
  EXPECT_EQ(number_, -2.0);
}

TEST_F(OptionSetTest, BothEndsOfARangeAreAllowedAndNothingBeyond) {
  EXPECT_TRUE(parse({"--timeout", "5"}));
  EXPECT_TRUE(parse({"--timeout", "-5"}));
  EXPECT_EQ(refusal({"--timeout", "5.001"}), "--timeout: \"5.001\" is not a number within -5..5");
  EXPECT_EQ(refusal({"--epos", "1,128"}), "--epos: \"128\" is not a number within 1..127");
}

TEST_F(OptionSetTest, WhatIsNoNumberIsRefused) {
  for (const char* text : {"nan", "inf", "", "1 s", "1,", "x", "0x1", " 1", "1e999"}) {
    const std::string words = refusal({"--timeout", text});
    EXPECT_NE(words.find("--timeout"), std::string::npos) << text << ": " << words;
    EXPECT_NE(refusal({"--clock-error-ppm", text}), "accepted") << text;
  }
  EXPECT_EQ(number_, 3.0);
  EXPECT_EQ(refusal({"--bitrate", "1.5"}), "--bitrate: \"1.5\" is not a whole number");
}

TEST_F(OptionSetTest, AnOptionWithoutItsValueIsRefused) {
  EXPECT_NE(refusal({"--goal"}).find("--goal"), std::string::npos);
  EXPECT_EQ(refusal({"--goal", "--timeout", "1"}), "--goal needs a value, and --timeout is none");
  EXPECT_NE(refusal({"--goal="}).find("--goal"), std::string::npos);
  EXPECT_EQ(text_, "before");
}

TEST_F(OptionSetTest, AnOptionGivenTwiceIsRefused) {
  EXPECT_NE(refusal({"--goal", "a", "--goal", "b"}).find("--goal"), std::string::npos);
}

TEST_F(OptionSetTest, AnUnknownOptionIsRefusedWithTheOneThatMayBeMeant) {
  EXPECT_EQ(refusal({"--tiemout", "1"}), "unknown argument --tiemout; did you mean --timeout?");
  EXPECT_EQ(refusal({"--timeouts=1"}), "unknown argument --timeouts; did you mean --timeout?");
  EXPECT_EQ(refusal({"--fast"}), "unknown argument --fast; --help lists all options");
  EXPECT_EQ(refusal({"-x"}), "unknown argument -x; --help lists all options");
  EXPECT_EQ(refusal({"--time", "1"}), "unknown argument --time; --help lists all options");
  EXPECT_EQ(refusal({"--goal", "a", "b"}), "unknown argument b; --help lists all options");
}

TEST_F(OptionSetTest, HelpIsAskedForAndSetsNothing) {
  EXPECT_FALSE(parse({"--help"}));
  EXPECT_FALSE(parse({"-h"}));
  EXPECT_FALSE(parse({"--timeout", "1", "--help"}));
  EXPECT_EQ(number_, 3.0);
}

TEST_F(OptionSetTest, HelpShowsSynopsisOptionsAndNotes) {
  const std::string help = options_.help();
  for (const char* text :
       {"program --goal FILE\n", "--goal FILE", "--timeout SECONDS", "s (default: 3)", "--help", "-h",
        "--bitrate BIT/S", "--clock-error-ppm PPM", "--epos NODES", "Exit code: 0."})
    EXPECT_NE(help.find(text), std::string::npos) << text << " is not in\n" << help;
}

TEST_F(OptionSetTest, ANumberMayBeToldFromNone) {
  std::optional<double> number;
  options_.add_number({"share", "PART", "of it"}, {0.0, 1.0}, number);
  ASSERT_TRUE(parse({}));
  EXPECT_EQ(number, std::nullopt);
  ASSERT_TRUE(parse({"--share", "0.5"}));
  EXPECT_EQ(number, 0.5);
  EXPECT_EQ(refusal({"--share", "2"}), "--share: \"2\" is not a number within 0..1");
}

TEST_F(OptionSetTest, WordsAreTakenWhereTheProgramAsksForThem) {
  std::vector<std::string> words{"of before"};
  options_.add_arguments(words);
  ASSERT_TRUE(parse({"0x6064:1", "--timeout", "1", "-4000", "-1e3", "a b"}));
  EXPECT_EQ(words, (std::vector<std::string>{"0x6064:1", "-4000", "-1e3", "a b"}));
  EXPECT_EQ(number_, 1.0);
  EXPECT_EQ(refusal({"-x"}), "unknown argument -x; --help lists all options");
  ASSERT_TRUE(parse({}));
  EXPECT_TRUE(words.empty());
}

TEST(ClosestName, IsTheLeastDifferentOneAndNoneThatIsTooDifferent) {
  const std::vector<std::string> names{"--goal", "--node", "--timeout"};
  EXPECT_EQ(closest_name("--gaol", names), "--goal");
  EXPECT_EQ(closest_name("--goals", names), "--goal");
  EXPECT_EQ(closest_name("--nod", names), "--node");
  EXPECT_EQ(closest_name("--time-out", names), "--timeout");
  EXPECT_EQ(closest_name("--wait", names), "");
  EXPECT_EQ(closest_name("", names), "");
}

}  // namespace
}  // namespace interpolated_motion::command_line
