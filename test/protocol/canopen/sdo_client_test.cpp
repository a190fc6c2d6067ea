#include "interpolated_motion_driver/protocol/canopen/sdo_client.h"

#include <gtest/gtest.h>

#include "protocol/canopen/bytes.h"
#include "protocol/canopen/sdo_exchange.h"

// Expected bytes are those of CiA 301, 7.2.4.3, and of maxon's "Interpolated Position Mode" for the record.
namespace interpolated_motion::canopen::test {
namespace {

constexpr std::uint32_t kRequest = 0x603;
constexpr std::uint32_t kReply = 0x583;

struct SdoClientTest : ::testing::Test {
  SdoClient client{3};
  HostTime now = at_ms(0);

  void reply(std::initializer_list<int> bytes) { client.on_frame(make_frame(kReply, bytes), now); }
  void expect_sent(std::initializer_list<int> bytes) {
    const auto frame = client.next_frame(now);
    ASSERT_TRUE(frame);
    EXPECT_EQ(*frame, make_frame(kRequest, bytes));
  }
};

TEST_F(SdoClientTest, ExpeditedDownloadOfEachSize) {
  const struct {
    std::vector<std::uint8_t> bytes;
    std::initializer_list<int> expected;
  } cases[] = {
      {{0x07}, {0x2F, 0x60, 0x60, 0, 0x07, 0, 0, 0}},
      {{0x0F, 0x01}, {0x2B, 0x60, 0x60, 0, 0x0F, 0x01, 0, 0}},
      {{1, 2, 3}, {0x27, 0x60, 0x60, 0, 1, 2, 3, 0}},
      {{1, 2, 3, 4}, {0x23, 0x60, 0x60, 0, 1, 2, 3, 4}},
  };
  for (const auto& c : cases) {
    ASSERT_TRUE(client.start_download({0x6060, 0}, c.bytes, now));
    expect_sent(c.expected);
    EXPECT_TRUE(client.busy());
    reply({0x60, 0x60, 0x60, 0, 0, 0, 0, 0});
    EXPECT_FALSE(client.busy());
    const auto result = client.take_result();
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->ok);
    EXPECT_FALSE(client.take_result());
  }
}

TEST_F(SdoClientTest, ExpeditedUploadOfEachSize) {
  const struct {
    int command;
    std::uint32_t expected;
    std::size_t size;
  } cases[] = {
      {0x4F, 0x11, 1}, {0x4B, 0x2211, 2}, {0x47, 0x332211, 3}, {0x43, 0x44332211, 4}, {0x42, 0x44332211, 4}};
  for (const auto& c : cases) {
    ASSERT_TRUE(client.start_upload({0x60C4, 2}, now));
    expect_sent({0x40, 0xC4, 0x60, 2, 0, 0, 0, 0});
    reply({c.command, 0xC4, 0x60, 2, 0x11, 0x22, 0x33, 0x44});
    const auto result = client.take_result();
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->ok);
    EXPECT_EQ(result->data.size(), c.size);
    EXPECT_EQ(result->as_u32(), c.expected);
  }
}

TEST_F(SdoClientTest, InterpolationDataRecordIsWrittenInSixFrames) {
  // P = -4096, V = -1500, T = 10.
  const std::vector<std::uint8_t> record{0x00, 0xF0, 0xFF, 0xFF, 0x24, 0xFA, 0xFF, 0x0A};
  ASSERT_TRUE(client.start_download({0x20C1, 0}, record, now));
  expect_sent({0x21, 0xC1, 0x20, 0x00, 0x08, 0, 0, 0});
  reply({0x60, 0xC1, 0x20, 0x00, 0, 0, 0, 0});
  expect_sent({0x00, 0x00, 0xF0, 0xFF, 0xFF, 0x24, 0xFA, 0xFF});
  reply({0x20, 0, 0, 0, 0, 0, 0, 0});
  expect_sent({0x1D, 0x0A, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(client.busy());
  reply({0x30, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(client.take_result()->ok);
}

TEST_F(SdoClientTest, SegmentedUpload) {
  ASSERT_TRUE(client.start_upload({0x1008, 0}, now));
  expect_sent({0x40, 0x08, 0x10, 0, 0, 0, 0, 0});
  reply({0x41, 0x08, 0x10, 0, 9, 0, 0, 0});
  expect_sent({0x60, 0, 0, 0, 0, 0, 0, 0});
  reply({0x00, 'E', 'P', 'O', 'S', '2', ' ', '7'});
  expect_sent({0x70, 0, 0, 0, 0, 0, 0, 0});
  reply({0x1B, '0', 0, 0, 0, 0, 0, 0});
  const auto result = client.take_result();
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->ok);
  EXPECT_EQ(result->data.size(), 9u);
  EXPECT_EQ(result->as_text(), "EPOS2 70");
}

TEST_F(SdoClientTest, BlockDownloadBytes) {
  const std::vector<std::uint8_t> nine{'1', '2', '3', '4', '5', '6', '7', '8', '9'};  // CRC 0x31C3
  ASSERT_TRUE(client.start_download({0x2000, 1}, nine, now, SdoTransfer::Block));
  expect_sent({0xC6, 0x00, 0x20, 1, 9, 0, 0, 0});
  reply({0xA4, 0x00, 0x20, 1, 127, 0, 0, 0});
  expect_sent({0x01, '1', '2', '3', '4', '5', '6', '7'});
  expect_sent({0x82, '8', '9', 0, 0, 0, 0, 0});
  EXPECT_FALSE(client.has_frame());
  reply({0xA2, 2, 127, 0, 0, 0, 0, 0});
  expect_sent({0xC1 | 5 << 2, 0xC3, 0x31, 0, 0, 0, 0, 0});
  reply({0xA1, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(client.take_result()->ok);
}

TEST_F(SdoClientTest, BlockUploadBytes) {
  ASSERT_TRUE(client.start_upload({0x2000, 1}, now, SdoTransfer::Block));
  expect_sent({0xA4, 0x00, 0x20, 1, 127, 0, 0, 0});
  reply({0xC6, 0x00, 0x20, 1, 9, 0, 0, 0});
  expect_sent({0xA3, 0, 0, 0, 0, 0, 0, 0});
  reply({0x01, '1', '2', '3', '4', '5', '6', '7'});
  EXPECT_FALSE(client.has_frame());
  reply({0x82, '8', '9', 0, 0, 0, 0, 0});
  expect_sent({0xA2, 2, 127, 0, 0, 0, 0, 0});
  reply({0xC1 | 5 << 2, 0xC3, 0x31, 0, 0, 0, 0, 0});
  expect_sent({0xA1, 0, 0, 0, 0, 0, 0, 0});
  const auto result = client.take_result();
  EXPECT_TRUE(result->ok);
  EXPECT_EQ(result->as_text(), "123456789");
}

TEST_F(SdoClientTest, BlockUploadWithWrongCrcIsAborted) {
  client.start_upload({0x2000, 1}, now, SdoTransfer::Block);
  client.next_frame(now);
  reply({0xC6, 0x00, 0x20, 1, 1, 0, 0, 0});
  client.next_frame(now);
  reply({0x81, 5, 0, 0, 0, 0, 0, 0});
  client.next_frame(now);
  reply({0xC1 | 6 << 2, 0x12, 0x34, 0, 0, 0, 0, 0});
  expect_sent({0x80, 0x00, 0x20, 1, 0x04, 0x00, 0x04, 0x05});
  EXPECT_EQ(client.take_result()->abort_code, 0x05040004u);
}

TEST_F(SdoClientTest, BlockUploadOfAnotherSizeThanAnnouncedIsAborted) {
  client.start_upload({0x2000, 1}, now, SdoTransfer::Block);
  client.next_frame(now);
  reply({0xC2, 0x00, 0x20, 1, 3, 0, 0, 0});
  client.next_frame(now);
  reply({0x81, 1, 2, 3, 4, 0, 0, 0});
  client.next_frame(now);
  reply({0xC1 | 3 << 2, 0, 0, 0, 0, 0, 0, 0});  // 4 bytes
  EXPECT_EQ(client.take_result()->abort_code, 0x06070010u);
}

TEST_F(SdoClientTest, WrongToggleAbortsUploadAndDownload) {
  client.start_upload({0x1008, 0}, now);
  client.next_frame(now);
  reply({0x41, 0x08, 0x10, 0, 9, 0, 0, 0});
  client.next_frame(now);
  reply({0x10, 1, 2, 3, 4, 5, 6, 7});
  expect_sent({0x80, 0x08, 0x10, 0, 0x00, 0x00, 0x03, 0x05});
  EXPECT_EQ(client.take_result()->abort_code, 0x05030000u);

  client.start_download({0x20C1, 0}, std::vector<std::uint8_t>(8), now);
  client.next_frame(now);
  reply({0x60, 0xC1, 0x20, 0, 0, 0, 0, 0});
  client.next_frame(now);
  reply({0x30, 0, 0, 0, 0, 0, 0, 0});
  expect_sent({0x80, 0xC1, 0x20, 0, 0x00, 0x00, 0x03, 0x05});
  EXPECT_EQ(client.take_result()->abort_code, 0x05030000u);
}

TEST_F(SdoClientTest, UnknownCommandForThisObjectIsAborted) {
  client.start_upload({0x6041, 0}, now);
  client.next_frame(now);
  reply({0xE0, 0x41, 0x60, 0, 0, 0, 0, 0});
  expect_sent({0x80, 0x41, 0x60, 0, 0x01, 0x00, 0x04, 0x05});
  EXPECT_EQ(client.take_result()->abort_code, 0x05040001u);
}

// The answer to a write comes after its time-out, when the same object is being read; and the reverse.
TEST_F(SdoClientTest, LateAnswerOfTheOtherDirectionIsNotTaken) {
  client.start_upload({0x6060, 0}, now);
  client.next_frame(now);
  reply({0x60, 0x60, 0x60, 0, 0, 0, 0, 0});
  EXPECT_TRUE(client.busy());
  reply({0x4F, 0x60, 0x60, 0, 7, 0, 0, 0});
  EXPECT_EQ(client.take_result()->as_u8(), 7);
  client.start_download({{0x6060, 0}, 1, 7}, now);
  client.next_frame(now);
  reply({0x4F, 0x60, 0x60, 0, 1, 0, 0, 0});
  EXPECT_TRUE(client.busy());
  reply({0x60, 0x60, 0x60, 0, 0, 0, 0, 0});
  EXPECT_TRUE(client.take_result()->ok);
}

TEST_F(SdoClientTest, UploadOfMoreOrLessThanAnnouncedIsAborted) {
  for (const auto& c : {std::pair<int, std::uint32_t>{5, 0x06070012u}, {8, 0x06070013u}}) {
    client.start_upload({0x1008, 0}, now);
    client.next_frame(now);
    reply({0x41, 0x08, 0x10, 0, c.first, 0, 0, 0});
    client.next_frame(now);
    reply({0x01, 1, 2, 3, 4, 5, 6, 7});
    EXPECT_EQ(client.take_result()->abort_code, c.second);
    client.next_frame(now);
  }
}

TEST_F(SdoClientTest, EndlessUploadIsAborted) {
  SdoParameters parameters;
  parameters.max_size = 100;
  SdoClient small(3, parameters);
  small.start_upload({0x1008, 0}, now);
  small.next_frame(now);
  small.on_frame(make_frame(kReply, {0x40, 0x08, 0x10, 0, 0, 0, 0, 0}), now);
  for (int i = 0; i < 20 && small.busy(); ++i) {
    small.next_frame(now);
    small.on_frame(make_frame(kReply, {i % 2 == 0 ? 0x00 : 0x10, 1, 2, 3, 4, 5, 6, 7}), now);
  }
  EXPECT_EQ(small.take_result()->abort_code, 0x05040005u);
}

TEST_F(SdoClientTest, EmptySegmentsThatNeverEndAreAborted) {
  client.start_upload({0x1008, 0}, now);
  client.next_frame(now);
  reply({0x40, 0x08, 0x10, 0, 0, 0, 0, 0});
  client.next_frame(now);
  reply({0x0E, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(client.take_result()->abort_code, 0x05040001u);
}

TEST_F(SdoClientTest, UploadAnnouncedTooLargeIsAbortedAtOnce) {
  for (SdoTransfer transfer : {SdoTransfer::Automatic, SdoTransfer::Block}) {
    client.start_upload({0x1008, 0}, now, transfer);
    client.next_frame(now);
    reply({transfer == SdoTransfer::Block ? 0xC2 : 0x41, 0x08, 0x10, 0, 0x01, 0x00, 0x01, 0});  // 65537 bytes
    expect_sent({0x80, 0x08, 0x10, 0, 0x05, 0x00, 0x04, 0x05});
    EXPECT_EQ(client.take_result()->abort_code, 0x05040005u);
  }
}

TEST_F(SdoClientTest, SequenceNumbersOutsideTheBlockAreAborted) {
  SdoParameters parameters;
  parameters.block_size = 10;
  for (int sequence : {0x00, 11, 0x80 | 11}) {
    SdoClient ten(3, parameters);
    ten.start_upload({0x2000, 1}, now, SdoTransfer::Block);
    ten.next_frame(now);
    ten.on_frame(make_frame(kReply, {0xC0, 0x00, 0x20, 1, 0, 0, 0, 0}), now);
    ten.next_frame(now);
    ten.on_frame(make_frame(kReply, {sequence, 1, 2, 3, 4, 5, 6, 7}), now);
    ASSERT_FALSE(ten.busy()) << sequence;
    EXPECT_EQ(ten.take_result()->abort_code, 0x05040003u);
  }
}

TEST_F(SdoClientTest, RepeatedAnswersToTheInitiateOfADownloadAreIgnored) {
  client.start_download({0x20C1, 0}, std::vector<std::uint8_t>(5), now);
  client.next_frame(now);
  reply({0x60, 0xC1, 0x20, 0, 0, 0, 0, 0});
  client.next_frame(now);
  reply({0x60, 0xC1, 0x20, 0, 0, 0, 0, 0});
  reply({0x20, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(client.take_result()->ok);

  client.start_download({0x20C1, 0}, std::vector<std::uint8_t>(5), now, SdoTransfer::Block);
  client.next_frame(now);
  reply({0xA0, 0xC1, 0x20, 0, 127, 0, 0, 0});
  expect_sent({0x81, 0, 0, 0, 0, 0, 0, 0});
  reply({0xA0, 0xC1, 0x20, 0, 127, 0, 0, 0});
  EXPECT_FALSE(client.has_frame());
  reply({0xA2, 1, 127, 0, 0, 0, 0, 0});
  expect_sent({0xC1 | 2 << 2, 0, 0, 0, 0, 0, 0, 0});
}

TEST_F(SdoClientTest, FramesThatCannotBelongToTheTransferAreIgnored) {
  reply({0x4B, 0x41, 0x60, 0, 0x37, 0x02, 0, 0});  // idle
  client.start_upload({0x6041, 0}, now);
  reply({0x4B, 0x41, 0x60, 0, 0xFF, 0xFF, 0, 0});  // before the request was sent
  client.next_frame(now);
  reply({0x4B, 0x64, 0x60, 0, 1, 0, 0, 0});  // another index
  reply({0x4B, 0x41, 0x60, 1, 1, 0, 0, 0});  // another sub-index
  reply({0x80, 0x64, 0x60, 0, 0, 0, 2, 6});  // abort of another object
  reply({0x4B, 0x41, 0x60, 0, 1, 0, 0});     // 7 bytes
  reply({});
  Frame remote = make_frame(kReply, {0x4B, 0x41, 0x60, 0, 1, 0, 0, 0});
  remote.remote = true;
  client.on_frame(remote, now);
  EXPECT_TRUE(client.busy());
  EXPECT_EQ(client.ignored_frames(), 8u);
  reply({0x4B, 0x41, 0x60, 0, 0x37, 0x02, 0, 0});
  EXPECT_EQ(client.take_result()->as_u32(), 0x0237u);
}

TEST_F(SdoClientTest, AnswersToBothTriesOfARepeatedRequestAreFine) {
  client.start_upload({0x1008, 0}, now);
  client.next_frame(now);
  now += client.timeout();
  client.poll(now);
  expect_sent({0x80, 0x08, 0x10, 0, 0x00, 0x00, 0x04, 0x05});
  EXPECT_EQ(client.take_result()->abort_code, 0x05040000u);
  client.start_upload({0x1008, 0}, now);
  client.next_frame(now);
  reply({0x41, 0x08, 0x10, 0, 3, 0, 0, 0});  // late, to the first
  expect_sent({0x60, 0, 0, 0, 0, 0, 0, 0});
  reply({0x41, 0x08, 0x10, 0, 3, 0, 0, 0});  // to the second
  reply({0x09, 'a', 'b', 'c', 0, 0, 0, 0});
  EXPECT_EQ(client.take_result()->as_text(), "abc");
}

TEST_F(SdoClientTest, DeadlineRunsFromTheFrameHandedOut) {
  EXPECT_EQ(client.next_deadline(), kNever);
  client.start_upload({0x6041, 0}, at_ms(0));
  EXPECT_EQ(client.next_deadline(), at_ms(250));
  client.next_frame(at_ms(40));
  EXPECT_EQ(client.next_deadline(), at_ms(290));
  client.poll(at_ms(289));
  EXPECT_TRUE(client.busy());
  client.poll(at_ms(290));
  EXPECT_FALSE(client.busy());
  EXPECT_EQ(client.next_deadline(), kNever);
}

TEST_F(SdoClientTest, RequestNeverSentNeedsNoAbort) {
  client.start_upload({0x6041, 0}, now);
  client.abort(0x08000000);
  EXPECT_FALSE(client.has_frame());
  EXPECT_EQ(client.take_result()->abort_code, 0x08000000u);
}

TEST_F(SdoClientTest, SecondStartWhileBusyIsRefused) {
  ASSERT_TRUE(client.start_upload({0x6041, 0}, now));
  EXPECT_FALSE(client.start_upload({0x6064, 0}, now));
  EXPECT_FALSE(client.start_download({0x6040, 0}, std::vector<std::uint8_t>{6, 0}, now));
  expect_sent({0x40, 0x41, 0x60, 0, 0, 0, 0, 0});
  EXPECT_FALSE(client.has_frame());
}

TEST_F(SdoClientTest, AbortGoesBeforeTheNextRequest) {
  client.start_upload({0x6041, 0}, now);
  client.next_frame(now);
  client.abort(0x08000000);
  client.start_upload({0x6064, 0}, now);
  expect_sent({0x80, 0x41, 0x60, 0, 0, 0, 0, 0x08});
  expect_sent({0x40, 0x64, 0x60, 0, 0, 0, 0, 0});
}

TEST_F(SdoClientTest, IntegersAreWrittenWithTheirSize) {
  client.start_download(sdo_write<std::int8_t>({0x6060, 0}, -1), now);
  expect_sent({0x2F, 0x60, 0x60, 0, 0xFF, 0, 0, 0});
  reply({0x60, 0x60, 0x60, 0, 0, 0, 0, 0});
  client.start_download(sdo_write<std::int16_t>({0x60C0, 0}, -1), now);
  expect_sent({0x2B, 0xC0, 0x60, 0, 0xFF, 0xFF, 0, 0});
  reply({0x60, 0xC0, 0x60, 0, 0, 0, 0, 0});
  client.start_download(sdo_write<std::int32_t>({0x607D, 1}, -2), now);
  expect_sent({0x23, 0x7D, 0x60, 1, 0xFE, 0xFF, 0xFF, 0xFF});
}

TEST_F(SdoClientTest, NegativeNumbersAreReadWithTheirSize) {
  client.start_upload({0x20F4, 0}, now);
  client.next_frame(now);
  reply({0x4B, 0xF4, 0x20, 0, 0xFE, 0xFF, 0, 0});
  const auto result = client.take_result();
  EXPECT_EQ(result->as_i32(), -2);
  EXPECT_EQ(result->as_i16(), -2);
  EXPECT_EQ(result->as_i64(), -2);
  EXPECT_EQ(result->as_u32(), 0xFFFEu);
}

TEST_F(SdoClientTest, TextNamesNodeObjectValueCodeAndLastFrame) {
  client.start_upload({0x6041, 0}, now);
  client.next_frame(now);
  reply({0x4B, 0x41, 0x60, 0, 0x37, 0x02, 0, 0});
  EXPECT_EQ(client.take_result()->text(), "node 3: read of 0x6041:00 = 0x0237");

  client.start_download(sdo_write<std::int8_t>({0x6060, 0}, 7), now);
  client.next_frame(now);
  reply({0x80, 0x60, 0x60, 0, 0x22, 0x00, 0x00, 0x08});
  EXPECT_EQ(client.take_result()->text(),
            "node 3: write of 0x6060:00 = 0x07 failed: abort 0x08000022 data cannot be stored in the present "
            "device "
            "state (sent by the drive; last sent to the drive: 603#2F60600007000000)");
}

TEST(SdoClient, RefusesParametersOutOfRange) {
  EXPECT_THROW(SdoClient(0), std::invalid_argument);
  EXPECT_THROW(SdoClient(128), std::invalid_argument);
  SdoParameters parameters;
  parameters.block_size = 128;
  EXPECT_THROW(SdoClient(1, parameters), std::invalid_argument);
  parameters.block_size = 127;
  parameters.timeout = HostDuration::zero();
  EXPECT_THROW(SdoClient(1, parameters), std::invalid_argument);
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
