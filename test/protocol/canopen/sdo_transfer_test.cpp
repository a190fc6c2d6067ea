#include <gtest/gtest.h>

#include <random>

#include "interpolated_motion_driver/protocol/canopen/sdo_abort.h"
#include "protocol/canopen/sdo_exchange.h"
#include "protocol/property_cases.h"

// Whole transfers against the server of the tests, with faults.
namespace interpolated_motion::canopen::test {
namespace {

using interpolated_motion::test::below;
using interpolated_motion::test::property_cases;
using Bytes = std::vector<std::uint8_t>;

constexpr ObjectAddress kObject{0x2000, 5};
constexpr std::uint32_t kKey = 0x200005;

Bytes random_bytes(std::mt19937_64& random, std::size_t size) {
  Bytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 40);
  return bytes;
}

Bytes bytes_of(const SdoData& data) { return {data.data(), data.data() + data.size()}; }

/// One random transfer set-up: kind, sizes of blocks, options of the server.
struct RandomTransfer {
  explicit RandomTransfer(std::mt19937_64& random)
      : transfer(below(random, 2) == 0 ? SdoTransfer::Automatic : SdoTransfer::Block),
        bytes(random_bytes(random, below(random, 4) == 0 ? below(random, 16) : below(random, 1001))) {
    parameters.block_size = static_cast<std::uint8_t>(1 + below(random, 127));
    block_size = static_cast<int>(1 + below(random, 127));
    announce_size = below(random, 2) == 0;
    crc = below(random, 2) == 0;
    block_transfer = below(random, 4) != 0;
  }

  void apply(SdoServer& server) const {
    server.block_size = block_size;
    // Without a size, an expedited reply is always 4 bytes long: nothing a client could do about it.
    server.announce_size = announce_size || bytes.size() < 4;
    server.crc = crc;
    server.block_transfer = block_transfer;
  }

  SdoTransfer transfer;
  Bytes bytes;
  SdoParameters parameters;
  int block_size = 127;
  bool announce_size = true;
  bool crc = true;
  bool block_transfer = true;
};

TEST(SdoTransfer, UploadsReturnTheBytesOfTheServer) {
  std::mt19937_64 random(1);
  for (int i = 0; i < property_cases(300); ++i) {
    const RandomTransfer setup(random);
    SdoExchange exchange(setup.parameters);
    setup.apply(exchange.server);
    exchange.server.objects[kKey] = setup.bytes;
    ASSERT_TRUE(exchange.client.start_upload(kObject, exchange.now, setup.transfer));
    const auto result = exchange.run();
    ASSERT_TRUE(result) << i;
    ASSERT_TRUE(result->ok) << i << ": " << result->text();
    ASSERT_EQ(bytes_of(result->data), setup.bytes) << i;
    ASSERT_TRUE(exchange.server.idle()) << i;
  }
}

TEST(SdoTransfer, DownloadsArriveAtTheServer) {
  std::mt19937_64 random(2);
  for (int i = 0; i < property_cases(300); ++i) {
    const RandomTransfer setup(random);
    SdoExchange exchange(setup.parameters);
    setup.apply(exchange.server);
    ASSERT_TRUE(exchange.client.start_download(kObject, setup.bytes, exchange.now, setup.transfer));
    const auto result = exchange.run();
    ASSERT_TRUE(result) << i;
    if (setup.transfer == SdoTransfer::Block && !setup.block_transfer) {
      ASSERT_EQ(result->abort_code, abort_code::kCommand) << i;
      continue;
    }
    ASSERT_TRUE(result->ok) << i << ": " << result->text();
    ASSERT_EQ(exchange.server.objects[kKey], setup.bytes) << i;
    ASSERT_TRUE(exchange.server.idle()) << i;
  }
}

/// Whether a reply or request is a segment of a block that is neither the block's nor the transfer's last.
bool inner_segment(const Frame& frame, int block_size) {
  return frame.data[0] >= 1 && frame.data[0] < block_size;
}

TEST(SdoTransfer, LostSegmentsOfABlockAreRepeated) {
  std::mt19937_64 random(3);
  for (int i = 0; i < property_cases(200); ++i) {
    const bool upload = below(random, 2) == 0;
    const Bytes bytes = random_bytes(random, 200 + below(random, 800));
    SdoExchange exchange;
    exchange.client = SdoClient(3, [] {
      SdoParameters parameters;
      parameters.block_size = 20;
      return parameters;
    }());
    exchange.server.block_size = 20;
    int lost = 0;
    const auto lose = [&random, &lost](const Frame& frame) {
      const bool now = inner_segment(frame, 20) && lost < 5 && below(random, 10) == 0;
      lost += now ? 1 : 0;
      return now;
    };
    if (upload) {
      exchange.server.objects[kKey] = bytes;
      exchange.server.on_reply = [&lose](int n, Frame& frame) { return n == 0 || !lose(frame); };
      exchange.client.start_upload(kObject, exchange.now, SdoTransfer::Block);
    } else {
      exchange.server.on_request = [&lose](int n, const Frame& frame) { return n == 0 || !lose(frame); };
      exchange.client.start_download(kObject, bytes, exchange.now, SdoTransfer::Block);
    }
    const auto result = exchange.run();
    ASSERT_TRUE(result && result->ok) << i << ": " << result->text();
    ASSERT_EQ(upload ? bytes_of(result->data) : exchange.server.objects[kKey], bytes) << i;
  }
}

struct Kind {
  const char* name;
  SdoDirection direction;
  SdoTransfer transfer;
  std::size_t size;
};

constexpr Kind kKinds[] = {
    {"expedited upload", SdoDirection::Upload, SdoTransfer::Automatic, 2},
    {"segmented upload", SdoDirection::Upload, SdoTransfer::Automatic, 20},
    {"block upload", SdoDirection::Upload, SdoTransfer::Block, 20},
    {"expedited download", SdoDirection::Download, SdoTransfer::Automatic, 2},
    {"segmented download", SdoDirection::Download, SdoTransfer::Automatic, 20},
    {"block download", SdoDirection::Download, SdoTransfer::Block, 20},
};

void start(SdoExchange& exchange, const Kind& kind) {
  const Bytes bytes(kind.size, 0x5A);
  if (kind.direction == SdoDirection::Upload) {
    exchange.server.objects[kKey] = bytes;
    exchange.client.start_upload(kObject, exchange.now, kind.transfer);
  } else {
    exchange.client.start_download(kObject, bytes, exchange.now, kind.transfer);
  }
}

/// Replies of the server in an undisturbed transfer.
int replies_of(const Kind& kind) {
  SdoExchange exchange;
  start(exchange, kind);
  EXPECT_TRUE(exchange.run()->ok) << kind.name;
  return exchange.server.replies();
}

TEST(SdoTransfer, SilenceAtEachStepEndsInATimeOutAndTheNextTransferWorks) {
  for (const Kind& kind : kKinds) {
    const int replies = replies_of(kind);
    for (int step = 0; step < replies; ++step) {
      SdoExchange exchange;
      exchange.server.on_reply = [step](int n, Frame&) { return n < step; };
      start(exchange, kind);
      const HostTime begin = exchange.now;
      const auto result = exchange.run();
      ASSERT_TRUE(result) << kind.name << step;
      EXPECT_FALSE(result->ok) << kind.name << step;
      EXPECT_EQ(result->abort_code, abort_code::kTimeout) << kind.name << step;
      EXPECT_FALSE(result->aborted_by_drive);
      EXPECT_GE(exchange.now - begin, exchange.client.timeout());
      EXPECT_EQ(exchange.server.client_abort(), abort_code::kTimeout) << kind.name << step;

      exchange.server.on_reply = [](int, Frame&) { return true; };
      start(exchange, kind);
      EXPECT_TRUE(exchange.run()->ok) << kind.name << step;
    }
  }
}

TEST(SdoTransfer, RequestsLostAtEachStepEndInATimeOut) {
  for (const Kind& kind : kKinds) {
    SdoExchange whole;
    start(whole, kind);
    whole.run();
    // The last request of a block upload is a confirmation that nothing answers.
    const bool unanswered_end = kind.transfer == SdoTransfer::Block && kind.direction == SdoDirection::Upload;
    const int requests = whole.server.requests() - (unanswered_end ? 1 : 0);
    for (int step = 0; step < requests; ++step) {
      SdoExchange exchange;
      exchange.server.on_request = [step](int n, const Frame& frame) {
        return n < step || frame.data[0] == 0x80;
      };
      start(exchange, kind);
      EXPECT_EQ(exchange.run()->abort_code, abort_code::kTimeout) << kind.name << step;
    }
  }
}

TEST(SdoTransfer, AnAbortOfTheDriveAtEachStepEndsTheTransfer) {
  for (const Kind& kind : kKinds) {
    const int replies = replies_of(kind);
    for (int step = 0; step < replies; ++step) {
      SdoExchange exchange;
      exchange.server.on_reply = [step](int n, Frame& frame) {
        if (n == step) frame = make_frame(0x583, {0x80, 0x00, 0x20, 5, 0x21, 0x00, 0x00, 0x08});
        return n <= step;
      };
      start(exchange, kind);
      const auto result = exchange.run();
      EXPECT_EQ(result->abort_code, 0x08000021u) << kind.name << step;
      EXPECT_TRUE(result->aborted_by_drive) << kind.name << step;
      EXPECT_EQ(exchange.server.client_abort(), 0u) << kind.name << step;
    }
  }
}

TEST(SdoTransfer, AnUnexpectedCommandAtEachStepNeverCompletesTheTransfer) {
  for (const Kind& kind : kKinds) {
    const int replies = replies_of(kind);
    for (int step = 0; step < replies; ++step) {
      SdoExchange exchange;
      exchange.server.on_reply = [step](int n, Frame& frame) {
        if (n == step) frame.data[0] = 0xE0;  // no such server command; in a block: segment 96, the last
        return true;
      };
      start(exchange, kind);
      const auto result = exchange.run();
      ASSERT_TRUE(result) << kind.name << step;
      if (kind.transfer != SdoTransfer::Block || kind.direction != SdoDirection::Upload) {
        EXPECT_EQ(result->abort_code, abort_code::kCommand) << kind.name << step;
      }
      EXPECT_TRUE(!result->ok || bytes_of(result->data) == Bytes(kind.size, 0x5A)) << kind.name << step;
    }
  }
}

TEST(SdoTransfer, CorruptedBlockIsRefusedByWhoeverReceivesIt) {
  SdoExchange up;
  up.server.on_reply = [](int n, Frame& frame) {
    if (n == 2) frame.data[3] = static_cast<std::uint8_t>(frame.data[3] ^ 1);
    return true;
  };
  start(up, kKinds[2]);
  EXPECT_EQ(up.run()->abort_code, abort_code::kCrc);
  EXPECT_EQ(up.server.client_abort(), abort_code::kCrc);

  SdoExchange down;
  down.server.on_reply = [](int n, Frame& frame) {
    if (n == 0) frame.data[0] = 0xA0;  // hides from the client that the server checks the CRC
    return true;
  };
  start(down, kKinds[5]);
  const auto result = down.run();
  EXPECT_EQ(result->abort_code, abort_code::kCrc);
  EXPECT_TRUE(result->aborted_by_drive);
}

TEST(SdoTransfer, ServerThatNeverAcknowledgesABlockIsGivenUp) {
  SdoExchange exchange;
  exchange.server.on_reply = [](int n, Frame& frame) {
    if (n > 0) frame.data[1] = 0;
    return true;
  };
  start(exchange, kKinds[5]);
  exchange.server.on_request = [](int n, const Frame& frame) { return n == 0 || frame.data[0] != 1; };
  const auto result = exchange.run();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->abort_code, abort_code::kSequence);
  // Initiate, four times the three segments, abort.
  EXPECT_EQ(exchange.server.requests(), 1 + 4 * 3 + 1);
}

TEST(SdoTransfer, ImpossibleAcknowledgesOfABlockAreAborted) {
  for (const auto& c : {std::pair<int, int>{1, 100}, {2, 0}, {2, 128}}) {
    SdoExchange exchange;
    exchange.server.block_size = 2;
    exchange.server.on_reply = [c](int n, Frame& frame) {
      if (n == 1) frame.data[static_cast<std::size_t>(c.first)] = static_cast<std::uint8_t>(c.second);
      return true;
    };
    start(exchange, kKinds[5]);
    EXPECT_EQ(exchange.run()->abort_code, c.first == 1 ? abort_code::kSequence : abort_code::kBlockSize);
  }
}

TEST(SdoTransfer, EveryAbortCodeIsReportedWithItsText) {
  const std::pair<std::uint32_t, const char*> codes[] = {
      {0x05030000, "toggle"},       {0x05040000, "timed out"},   {0x05040001, "command"},
      {0x05040002, "block size"},   {0x05040003, "sequence"},    {0x05040004, "CRC"},
      {0x05040005, "memory"},       {0x06010000, "unsupported"}, {0x06010001, "write-only"},
      {0x06010002, "read-only"},    {0x06010003, "sub-index 0"}, {0x06020000, "does not exist"},
      {0x06040041, "mapped"},       {0x06040042, "length"},      {0x06040043, "parameter"},
      {0x06040047, "internal"},     {0x06060000, "hardware"},    {0x06070010, "length"},
      {0x06070012, "too long"},     {0x06070013, "too short"},   {0x06090011, "sub-index"},
      {0x06090030, "out of range"}, {0x06090031, "too high"},    {0x06090032, "too low"},
      {0x06090036, "maximum"},      {0x060A0023, "resource"},    {0x08000000, "general"},
      {0x08000020, "stored"},       {0x08000021, "local"},       {0x08000022, "device state"},
      {0x08000023, "dictionary"},   {0x08000024, "no data"},     {0x0F00FFC0, "NMT state"},
      {0x0F00FFBF, "illegal"},      {0x0F00FFBE, "password"},    {0x0F00FFBC, "service mode"},
      {0x0F00FFB9, "CAN"},          {0x12345678, "unknown"},
  };
  for (const auto& c : codes) {
    SdoExchange exchange;
    exchange.server.refuse_with = c.first;
    start(exchange, kKinds[0]);
    const auto result = exchange.run();
    EXPECT_FALSE(result->ok);
    EXPECT_EQ(result->abort_code, c.first);
    EXPECT_NE(std::string(describe_abort(c.first)).find(c.second), std::string::npos) << std::hex << c.first;
    EXPECT_NE(result->text().find(describe_abort(c.first)), std::string::npos);
  }
}

TEST(SdoTransfer, GarbageNeverKeepsATransferRunning) {
  std::mt19937_64 random(4);
  for (int i = 0; i < property_cases(2000); ++i) {
    SdoExchange exchange;
    start(exchange, kKinds[below(random, 6)]);
    for (int n = 0; n < 50; ++n) {
      exchange.client.next_frame(exchange.now);
      Frame frame = make_frame(0x583, {0x60, 0x00, 0x20, 5, 1, 0, 0, 0});
      frame.data[0] = static_cast<std::uint8_t>(random() >> 40);
      if (below(random, 2) == 0) put_le(frame.data.data() + 1, static_cast<std::uint32_t>(random() >> 20));
      if (below(random, 10) == 0) frame.length = static_cast<std::uint8_t>(below(random, 16));
      exchange.client.on_frame(frame, exchange.now);
      exchange.now += std::chrono::milliseconds(below(random, 20));
    }
    while (exchange.client.next_frame(exchange.now)) continue;
    exchange.client.poll(exchange.now + exchange.client.timeout());
    ASSERT_FALSE(exchange.client.busy()) << i;
    ASSERT_TRUE(exchange.client.take_result()) << i;
  }
}

}  // namespace
}  // namespace interpolated_motion::canopen::test
