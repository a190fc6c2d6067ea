#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <istream>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/streambuf.hpp>

#include "can_server.h"
#include "options.h"

namespace interpolated_motion::emulated_drives {
namespace {

constexpr int kEnded = 0;
constexpr int kBadInput = 2;

void say(const std::string& text) {
  std::puts(text.c_str());
  std::fflush(stdout);
}

/// Lines of the standard input: faults for the drives.
class CommandInput {
 public:
  CommandInput(boost::asio::io_context& io, CanServer& server) : server_(server), input_(io) {
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
    std::string reason;
    const bool done = server_.inject(target, command, &reason);
    say(done ? "done: " + line : "refused: " + reason);
  }

  CanServer& server_;
  boost::asio::posix::stream_descriptor input_;
  boost::asio::streambuf buffer_;
};

int serve(const Options& options) {
  boost::asio::io_context io;
  CanServer server(io, options.interface, make_drive_list(options), say);
  boost::asio::signal_set signals(io, SIGINT, SIGTERM);
  signals.async_wait([&io](const auto& error, int) {
    if (!error) io.stop();
  });
  CommandInput commands(io, server);
  server.start();
  io.run();
  return kEnded;
}

}  // namespace
}  // namespace interpolated_motion::emulated_drives

int main(int argc, char** argv) {
  using namespace interpolated_motion::emulated_drives;
  try {
    const Options options = parse_options(std::vector<std::string>(argv + 1, argv + argc));
    if (options.help) {
      std::fputs(usage().c_str(), stdout);
      return kEnded;
    }
    return serve(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "emulated_drives: %s\n", error.what());
    return kBadInput;
  }
}
