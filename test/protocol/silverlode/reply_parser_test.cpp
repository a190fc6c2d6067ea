#include "interpolated_motion_driver/protocol/silverlode/reply_parser.h"

#include <gtest/gtest.h>

#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "protocol/property_cases.h"

namespace interpolated_motion::silverlode::test {
namespace {

using interpolated_motion::test::below;
using interpolated_motion::test::property_cases;

/// What a text makes of a parser, character i arriving at i + 1 ms.
struct Result {
  std::vector<Reply> replies;
  std::vector<std::string> malformed;
  int echoes = 0;
};

Result parse(ReplyParser& parser, const std::string& text) {
  Result result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    switch (parser.on_character(text[i], HostTime{std::chrono::milliseconds(i + 1)})) {
      case Parsed::Nothing:
        break;
      case Parsed::Reply:
        result.replies.push_back(parser.reply());
        break;
      case Parsed::Echo:
        ++result.echoes;
        break;
      case Parsed::Malformed:
        result.malformed.emplace_back(parser.line().view());
        break;
    }
  }
  return result;
}

Result parse(const std::string& text) {
  ReplyParser parser;
  return parse(parser, text);
}

std::optional<Reply> single_reply(const std::string& text) {
  const Result result = parse(text);
  EXPECT_LE(result.replies.size() + result.malformed.size(), 1u) << text;
  if (result.replies.size() != 1) return std::nullopt;
  return result.replies[0];
}

TEST(ReplyParser, Acknowledge) {
  const auto reply = single_reply("* 10\r");
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->type, ReplyType::Ack);
  EXPECT_EQ(reply->address, 16);
  EXPECT_EQ(reply->begin, HostTime{std::chrono::milliseconds(1)});
  EXPECT_EQ(reply->end, HostTime{std::chrono::milliseconds(5)});
}

TEST(ReplyParser, DataOfOneAndOfTwoWords) {
  const auto status = single_reply("# 10 0014 00F3\r");
  ASSERT_TRUE(status);
  EXPECT_EQ(status->type, ReplyType::Data);
  EXPECT_EQ(status->command, 20);
  ASSERT_EQ(status->word_count, 1);
  EXPECT_EQ(status->words[0], 0x00F3);

  const auto position = single_reply("# 10 000C 0001 6760\r");
  ASSERT_TRUE(position);
  EXPECT_EQ(position->command, 12);
  ASSERT_EQ(position->word_count, 2);
  EXPECT_EQ(position->words[0], 0x0001);
  EXPECT_EQ(position->words[1], 0x6760);
}

TEST(ReplyParser, EightWordsAndNoMore) {
  const std::string eight = "# FE 000C 0001 0002 0003 0004 0005 0006 0007 ABCD";
  const auto reply = single_reply(eight + "\r");
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->address, 254);
  EXPECT_EQ(reply->word_count, 8);
  EXPECT_EQ(reply->words[7], 0xABCD);
  EXPECT_FALSE(single_reply(eight + " 0009\r"));
}

TEST(ReplyParser, Refusal) {
  const auto reply = single_reply("! 10 0019 0006\r");
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->type, ReplyType::Nak);
  EXPECT_EQ(reply->command, 25);
  EXPECT_EQ(reply->nak, NakCode::BufferFull);
  EXPECT_EQ(single_reply("! 10 00FD 0002\r")->nak, NakCode::DeviceBusy);
}

TEST(ReplyParser, Tolerated) {
  for (const char* text : {"*  10\r", "* 10 \r", "* 10\r\n", "\n* 10\r", "\r\r* 10\r", "  * 10\r",
                           "xyz* 10\r", "* 1* 10\r", "# 10 00! 10* 10\r", "\xFF\x01* 10\r", "* 1\n0\r"}) {
    const auto reply = single_reply(text);
    ASSERT_TRUE(reply) << text;
    EXPECT_EQ(reply->type, ReplyType::Ack) << text;
    EXPECT_EQ(reply->address, 16) << text;
  }
  EXPECT_EQ(single_reply("#  10   000c 00f3  \r")->words[0], 0x00F3);
}

TEST(ReplyParser, Malformed) {
  for (const char* text : {"* \r",
                           "*\r",
                           "*10\r",
                           "* 1\r",
                           "* 100\r",
                           "* 1G\r",
                           "* 10 0\r",
                           "* -1\r",
                           "10\r",
                           "hello\r",
                           "# 10\r",
                           "# 10 000C\r",
                           "# 10 000C 123\r",
                           "# 10 000C 12345\r",
                           "# 10 0C 1234\r",
                           "# 10 000C 12 34\r",
                           "#10 000C 1234\r",
                           "# 10 000C 1234x\r",
                           "! 10 0019\r",
                           "! 10 0019 006\r",
                           "! 10 0019 0006 0001\r",
                           "! 10\r",
                           "# 10\t000C 1234\r"}) {
    const Result result = parse(text);
    EXPECT_EQ(result.replies.size(), 0u) << text;
    ASSERT_EQ(result.malformed.size(), 1u) << text;
    EXPECT_EQ(result.malformed[0] + "\r", text);
  }
}

TEST(ReplyParser, OwnEcho) {
  const Result result = parse("@16 12 1\r# 10 000C 0001 6760\r");
  EXPECT_EQ(result.echoes, 1);
  EXPECT_EQ(result.replies.size(), 1u);
  EXPECT_TRUE(result.malformed.empty());
}

TEST(ReplyParser, OverlongLinesEndAtTheirCr) {
  for (const std::size_t length : {65u, 100u, 1000000u}) {
    const Result result = parse("* 10" + std::string(length, ' ') + "\r* 11\r");
    ASSERT_EQ(result.malformed.size(), 1u);
    EXPECT_EQ(result.malformed[0].size(), 64u);
    ASSERT_EQ(result.replies.size(), 1u);
    EXPECT_EQ(result.replies[0].address, 17);
  }
}

TEST(ReplyParser, UnfinishedLine) {
  ReplyParser parser;
  EXPECT_FALSE(parser.in_line());
  parse(parser, "* 1");
  EXPECT_TRUE(parser.in_line());
  EXPECT_EQ(parser.line().view(), "* 1");
  parser.reset();
  EXPECT_FALSE(parser.in_line());
  EXPECT_EQ(parser.dropped_characters(), 3u);
  EXPECT_EQ(parse(parser, "* 10\r").replies.size(), 1u);
  EXPECT_FALSE(parser.in_line());
}

/// The grammar of the replies once more, as a regular expression over the text behind the last start of a
/// line.
bool is_reply_line(const std::string& line) {
  std::string kept;
  for (const char c : line) {
    if (c != '\n') kept += c;
  }
  const std::size_t start = kept.find_last_of("*#!@");
  if (start == std::string::npos) return false;
  kept.erase(0, start);
  static const std::regex grammar(
      "(\\* +[0-9A-Fa-f]{2} *)|(# +[0-9A-Fa-f]{2} +[0-9A-Fa-f]{4}( +[0-9A-Fa-f]{4}){1,8} *)|"
      "(! +[0-9A-Fa-f]{2}( +[0-9A-Fa-f]{4}){2} *)");
  return kept.size() <= 64 && std::regex_match(kept, grammar);
}

std::string random_reply(std::mt19937_64& random) {
  static const char* const replies[] = {"* 10", "# 10 0014 00F3", "# 10 000C 0001 6760", "! 10 0019 0006"};
  return replies[below(random, 4)];
}

/// Characters that come in replies are the worst garbage, so they come often.
char garbage(std::mt19937_64& random) {
  static const std::string likely = "*#!@ 00112AaFf\n\r";
  return below(random, 4) == 0 ? static_cast<char>(below(random, 256)) : likely[below(random, 16)];
}

// Garbage put in, characters taken out: the parser takes exactly the lines that the grammar allows, and after
// any of it a whole reply behind a CR is read.
TEST(ReplyParserProperty, TakesExactlyWhatTheGrammarAllows) {
  std::mt19937_64 random(20240607);
  ReplyParser parser;
  int taken = 0;
  int refused = 0;
  for (int i = 0; i < property_cases(20000); ++i) {
    std::string text = random_reply(random);
    for (std::uint32_t n = below(random, 4); n > 0; --n) {
      const std::size_t at = below(random, static_cast<std::uint32_t>(text.size() + 1));
      if (below(random, 3) == 0 && at < text.size()) {
        text.erase(at, 1);
      } else {
        text.insert(at, 1, garbage(random));
      }
    }
    text += '\r';
    std::size_t expected = 0;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = text.find('\r', begin);
      expected += is_reply_line(text.substr(begin, end - begin)) ? 1 : 0;
      begin = end + 1;
    }
    ASSERT_EQ(parse(parser, text).replies.size(), expected) << "case " << i << ": " << text;
    ASSERT_EQ(parse(parser, "* 10\r").replies.size(), 1u) << "case " << i << " behind: " << text;
    taken += expected > 0 ? 1 : 0;
    refused += expected == 0 ? 1 : 0;
  }
  EXPECT_GT(taken, 0);
  EXPECT_GT(refused, 0);
}

TEST(ReplyParserProperty, SurvivesNoise) {
  std::mt19937_64 random(7);
  ReplyParser parser;
  for (int i = 0; i < property_cases(20000); ++i) {
    std::string noise;
    for (std::uint32_t n = below(random, 200); n > 0; --n) noise += static_cast<char>(below(random, 256));
    parse(parser, noise);
    const Result result = parse(parser, "! 10 0019 0006\r");
    ASSERT_EQ(result.replies.size(), 1u) << i;
    ASSERT_EQ(result.replies[0].nak, NakCode::BufferFull);
  }
}

}  // namespace
}  // namespace interpolated_motion::silverlode::test
