#pragma once

#include <cstdint>
#include <deque>

#include "interpolated_motion_driver/emulation/canopen/node_port.h"
#include "interpolated_motion_driver/emulation/canopen/sdo_server.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// The SDO server of a node on its bus (default SDO of CiA 301: 0x600 and 0x580 + node id): responses come
/// some time after their requests, and a block upload leaves room for PDOs.
class SdoChannel {
 public:
  /// Serves `objects` through `port`, which must both outlive it. `response_time`: >= 0.
  SdoChannel(SdoObjects& objects, NodePort& port, std::uint8_t node_id, HostDuration response_time)
      : server_(objects), port_(port), node_id_(node_id), response_time_(response_time) {}

  /// The COB-ID of requests to this node.
  std::uint32_t request_id() const;

  /// A frame with that COB-ID, heard at `now`.
  void on_request(const canopen::Frame& frame, HostTime now);

  /// When the next response is due, kNever when none is.
  HostTime next_response() const { return responses_.empty() ? kNever : responses_.front().due; }

  /// Sends what is due.
  void send_due(HostTime now);

  /// Once a sample: segments of a block upload, if one is under way, in the time of a response.
  void pump_segments(HostTime now);

  /// Forgets an unfinished transfer.
  void reset() { server_.reset(); }

  /// The same, and the responses that are due.
  void restart();

 private:
  struct Response {
    HostTime due{};        ///< when it is sent; in the order they were made
    canopen::Frame frame;  ///< of 8 bytes
  };

  void respond(const SdoServer::Bytes& bytes, HostTime now);

  SdoServer server_;
  NodePort& port_;
  const std::uint8_t node_id_;
  const HostDuration response_time_;
  std::deque<Response> responses_;
};

}  // namespace interpolated_motion::emulation
