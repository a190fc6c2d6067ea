#include "interpolated_motion_driver/protocol/silverlode/request.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "interpolated_motion_driver/protocol/silverlode/registers.h"

namespace interpolated_motion::silverlode::test {
namespace {

std::string text(const Request& request) { return std::string(request.text.view()); }

// Bring-up, streaming and stop of one drive, as the wire shows them; the segments are those of the example in
// QCI-TD044.
TEST(SilverLodeRequest, TextOnTheWire) {
  EXPECT_EQ(text(pol_request(16)), "@16 0\r");
  EXPECT_EQ(text(cpl_request(16, 65535)), "@16 1 65535\r");
  EXPECT_EQ(text(ris_request(16)), "@16 20\r");
  EXPECT_EQ(text(cis_request(16)), "@16 163\r");
  EXPECT_EQ(text(ttp_request(16)), "@16 146\r");
  EXPECT_EQ(text(emd_request(16)), "@16 227\r");
  EXPECT_EQ(text(ztp_request(16)), "@16 145\r");
  EXPECT_EQ(text(wri_request(16, registers::kImsControl, 0)), "@16 11 17 0\r");
  EXPECT_EQ(text(wri_request(16, registers::kImsDeceleration, 1073742)), "@16 11 19 1073742\r");
  EXPECT_EQ(text(imq_request(16)), "@16 254\r");
  EXPECT_EQ(text(imw_request(16, 4000, 1073741824, 1073742, 536870912)),
            "@16 25 4000 1073741824 1073742 536870912\r");
  EXPECT_EQ(text(imw_request(16, 0, 92000, 536871, 536870912)), "@16 25 0 92000 536871 536870912\r");
  EXPECT_EQ(text(ims_request(16)), "@16 253 0 0\r");
  EXPECT_EQ(text(rrg_request(16, registers::kActualPosition)), "@16 12 1\r");
  EXPECT_EQ(text(rio_request(16)), "@16 21\r");
  EXPECT_EQ(text(stp_request(16, 0)), "@16 3 0\r");
  EXPECT_EQ(text(stp_request(16, -1)), "@16 3 -1\r");
}

TEST(SilverLodeRequest, TextOfTheOthers) {
  EXPECT_EQ(text(hlt_request(17)), "@17 2\r");
  EXPECT_EQ(text(rst_request(17)), "@17 4\r");
  EXPECT_EQ(text(rvn_request(17)), "@17 5\r");
  EXPECT_EQ(text(por_request(17)), "@17 27\r");
  EXPECT_EQ(text(erl_request(17, 20000, -500, 833)), "@17 151 20000 -500 833\r");
  EXPECT_EQ(text(kmc_request(17, 0x0300, 65535)), "@17 167 768 65535\r");
  EXPECT_EQ(text(dmd_request(17)), "@17 228\r");
  EXPECT_EQ(text(adl_request(kGlobalAddress, 416)), "@255 173 416\r");
  EXPECT_EQ(text(rrg_request(17, 1, 18, 6, 17)), "@17 12 1 18 6 17\r");
}

TEST(SilverLodeRequest, LongestSegmentFits) {
  constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
  const Request request = imw_request(254, kLowest, kLowest, kLowest, kLowest);
  EXPECT_TRUE(request.text.complete());
  EXPECT_EQ(text(request), "@254 25 -2147483648 -2147483648 -2147483648 -2147483648\r");
}

TEST(SilverLodeRequest, KindsOfReply) {
  EXPECT_EQ(pol_request(16).reply, ReplyKind::AckOrData);
  EXPECT_EQ(por_request(16).reply, ReplyKind::Data);
  EXPECT_EQ(rst_request(16).reply, ReplyKind::None);
  EXPECT_EQ(stp_request(kGlobalAddress, -1).reply, ReplyKind::None);
  EXPECT_EQ(hlt_request(16).reply, ReplyKind::Ack);
  EXPECT_EQ(rrg_request(16, 1, 2, 3).reply_words, 6);
  EXPECT_EQ(ris_request(16).reply_words, 1);
}

TEST(SilverLodeRequest, OnlyWhatAddsUpIsNotRepeatable) {
  EXPECT_FALSE(imw_request(16, 1, 2, 3, 4).repeatable);
  EXPECT_FALSE(ims_request(16).repeatable);
  for (const Request& request :
       {pol_request(16), cpl_request(16, 1), hlt_request(16), stp_request(16, 0), wri_request(16, 19, 1),
        rrg_request(16, 1), imq_request(16), emd_request(16), cis_request(16)}) {
    EXPECT_TRUE(request.repeatable) << mnemonic(request.command);
  }
}

TEST(SilverLodeRequest, LengthOfReplies) {
  EXPECT_EQ(reply_characters(hlt_request(16)), std::string("* 10\r").size());
  EXPECT_EQ(longest_reply_characters(hlt_request(16)), std::string("! 10 0019 0006\r").size());
  EXPECT_EQ(reply_characters(rrg_request(16, 1)), std::string("# 10 000C 0001 6760\r").size());
  EXPECT_EQ(longest_reply_characters(rrg_request(16, 1)), std::string("# 10 000C 0001 6760\r").size());
  EXPECT_EQ(reply_characters(pol_request(16)), std::string("# 10 0000 2000\r").size());
  EXPECT_EQ(reply_characters(rst_request(16)), 0u);
  EXPECT_EQ(longest_reply_characters(rst_request(16)), 0u);
}

TEST(SilverLodeRequest, ArgumentsOfIms) {
  EXPECT_EQ(text(ims_request(16, "")), "@16 253\r");
  EXPECT_EQ(text(ims_request(16, "-1 1")), "@16 253 -1 1\r");
  EXPECT_EQ(text(ims_request(16, "1 2 3 4")), "@16 253 1 2 3 4\r");
  for (const char* wrong : {" ", "0 ", " 0", "0  0", "0,0", "a", "0x10", "1 2 3 4 5", "99999999999", "0\r"}) {
    EXPECT_THROW(ims_request(16, wrong), std::invalid_argument) << '"' << wrong << '"';
  }
}

TEST(SilverLodeRequest, PrintableText) {
  EXPECT_EQ(imq_request(16).text.printable(), "@16 254");
  EXPECT_EQ(LineText("* 1\x01\xFF").printable(), "* 1\\x01\\xFF");
  EXPECT_EQ(LineText(std::string(65, 'x')).printable(), std::string(64, 'x') + "...");
}

}  // namespace
}  // namespace interpolated_motion::silverlode::test
