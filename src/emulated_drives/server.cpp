#include "server.h"

#include "interpolated_motion_driver/transport/host_clock.h"

namespace interpolated_motion::emulated_drives {

Server::Server(boost::asio::io_context& io, Announcement announce)
    : world_(transport::read_host_clock()), timer_(io), announce_(std::move(announce)) {}

std::string Server::target_names() const {
  std::string names;
  for (const auto& [name, injector] : targets_) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void Server::turn_at(HostTime time) {
  timer_.expires_at(std::chrono::steady_clock::time_point(
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(time.time_since_epoch())));
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) turn();
  });
}

}  // namespace interpolated_motion::emulated_drives
