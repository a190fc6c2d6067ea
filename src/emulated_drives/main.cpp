#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/streambuf.hpp>

#include "can_server.h"
#include "drive_list.h"
#include "options.h"
#include "serial_server.h"

namespace interpolated_motion::emulated_drives {
namespace {

constexpr int kEnded = 0;
constexpr int kBadInput = 2;

using Servers = std::vector<std::unique_ptr<Server>>;

void say(const std::string& text) {
  std::puts(text.c_str());
  std::fflush(stdout);
}

/// Lines of the standard input: faults for the drives.
class CommandInput {
 public:
  CommandInput(boost::asio::io_context& io, const Servers& servers) : servers_(servers), input_(io) {
    // A file or /dev/null cannot be waited for; then there are no commands.
    boost::system::error_code error;
    input_.assign(dup(STDIN_FILENO), error);
    if (!error) read();
  }

 private:
  void read() {
    boost::asio::async_read_until(input_, buffer_, '\n',
                                  [this](const boost::system::error_code& error, std::size_t) {
                                    if (error) return;
                                    std::string line;
                                    std::istream stream(&buffer_);
                                    std::getline(stream, line);
                                    execute(line);
                                    read();
                                  });
  }

  void execute(const std::string& line) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string::npos) return;
    const std::size_t blank = line.find_first_of(" \t", begin);
    const std::string target = line.substr(begin, blank - begin);
    const std::string command = blank == std::string::npos ? "" : line.substr(blank + 1);
    const auto refused = inject(target, command);
    say(refused ? "refused: " + *refused : "done: " + line);
  }

  std::optional<std::string> inject(const std::string& target, const std::string& command) {
    std::vector<Server*> found;
    std::string names;
    for (const auto& server : servers_) {
      if (server->knows(target)) found.push_back(server.get());
      names += (names.empty() ? "" : ", ") + server->target_names();
    }
    if (found.size() == 1) return found.front()->inject(target, command);
    return found.empty() ? "\"" + target + "\" is neither a drive nor an interface; there are " + names
                         : "\"" + target + "\" is on two buses: call the drive by its joint";
  }

  const Servers& servers_;
  boost::asio::posix::stream_descriptor input_;
  boost::asio::streambuf buffer_;
};

std::unique_ptr<Server> make_server(boost::asio::io_context& io, const ServedBus& served,
                                    const std::string& samples_folder) {
  if (served.bus.type == hardware::BusType::Canopen)
    return std::make_unique<CanServer>(io, served, samples_folder, say);
  return std::make_unique<SerialServer>(io, served, samples_folder, say);
}

Servers make_servers(boost::asio::io_context& io, const Options& options) {
  Servers servers;
  for (const ServedBus& served : make_drive_list(options))
    servers.push_back(make_server(io, served, options.samples_folder));
  return servers;
}

int serve(const Options& options) {
  boost::asio::io_context io;
  const Servers servers = make_servers(io, options);
  boost::asio::signal_set signals(io, SIGINT, SIGTERM);
  signals.async_wait([&io](const auto& error, int) {
    if (!error) io.stop();
  });
  CommandInput commands(io, servers);
  for (const auto& server : servers) server->start();
  io.run();
  return kEnded;
}

}  // namespace
}  // namespace interpolated_motion::emulated_drives

int main(int argc, char** argv) {
  using namespace interpolated_motion::emulated_drives;
  try {
    const auto options = parse_options(std::vector<std::string>(argv + 1, argv + argc));
    if (options) return serve(*options);
    std::fputs(usage().c_str(), stdout);
    return kEnded;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "emulated_drives: %s\n", error.what());
    return kBadInput;
  }
}
