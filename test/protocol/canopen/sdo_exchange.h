#pragma once

#include <optional>

#include "interpolated_motion_driver/protocol/canopen/sdo_client.h"
#include "protocol/canopen/bytes.h"
#include "protocol/canopen/sdo_server.h"

namespace interpolated_motion::canopen::test {

/// A client and a server on a perfect wire: every frame takes 100 us; when nothing moves, time goes on to the
/// client's deadline.
struct SdoExchange {
  explicit SdoExchange(SdoParameters parameters = {}) : client(3, parameters), server(3) {}

  /// Runs until the transfer has ended and its last frames are delivered. Empty when it never does.
  std::optional<SdoResult> run() {
    for (int step = 0; step < 100000; ++step) {
      if (const auto frame = client.next_frame(now)) {
        deliver(*frame);
      } else if (client.busy()) {
        now = client.next_deadline();
        client.poll(now);
      } else {
        return client.take_result();
      }
    }
    return std::nullopt;
  }

  SdoClient client;
  SdoServer server;
  HostTime now = at_ms(1000);
  std::vector<Frame> sent;

 private:
  void deliver(const Frame& frame) {
    sent.push_back(frame);
    now += std::chrono::microseconds(100);
    for (const Frame& reply : server.handle(frame)) {
      now += std::chrono::microseconds(100);
      client.on_frame(reply, now);
    }
  }
};

}  // namespace interpolated_motion::canopen::test
