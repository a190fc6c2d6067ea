#pragma once

#include <functional>
#include <memory>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/system/error_code.hpp>

#include "interpolated_motion_driver/transport/serial_line.h"

namespace interpolated_motion::transport {

/// The far end of a serial line for emulated drives: a pseudo-terminal that another program opens by its path
/// as if it were a serial port. Characters pass at once, without the time they take on a wire.
class PseudoTerminal : public SerialLine {
 public:
  using WaitHandler = std::function<void(const boost::system::error_code&)>;

  /// A new pseudo-terminal, raw. With `link` not empty, a symbolic link of that name leads to it for as long
  /// as this object lives. Throws std::runtime_error naming what failed.
  explicit PseudoTerminal(boost::asio::io_context& io, std::string link = "");
  ~PseudoTerminal() override;
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// What the other program opens: the link if there is one, else "/dev/pts/N".
  const std::string& path() const;

  bool send(std::string_view text, HostTime now) override;
  std::optional<ReceivedCharacter> receive() override;

  /// Calls `handler` once when characters can be read.
  void async_wait_readable(WaitHandler handler);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace interpolated_motion::transport
