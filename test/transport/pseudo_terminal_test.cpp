#include "interpolated_motion_driver/transport/pseudo_terminal.h"

#include <unistd.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <boost/asio/io_context.hpp>

namespace interpolated_motion::transport {
namespace {

namespace fs = std::filesystem;

class TerminalLink : public testing::Test {
 protected:
  void TearDown() override { fs::remove(link_); }

  void leads_to(const std::string& target) const { fs::create_symlink(target, link_); }

  boost::asio::io_context io_;
  const std::string link_ = testing::TempDir() + "imd_link_" + std::to_string(getpid());
};

TEST_F(TerminalLink, IsThereAsLongAsTheTerminal) {
  {
    const PseudoTerminal terminal(io_, link_);
    EXPECT_EQ(fs::read_symlink(link_).string().rfind("/dev/pts/", 0), 0U);
  }
  EXPECT_FALSE(fs::is_symlink(link_));
}

TEST_F(TerminalLink, OfATerminalThatIsNoMoreIsReplaced) {
  leads_to("/dev/pts/999999");
  EXPECT_NO_THROW(PseudoTerminal(io_, link_));
}

// A user's link to a file that does not exist at present, a disk that is not mounted.
TEST_F(TerminalLink, OfSomebodyElseIsKeptThoughItLeadsNowhere) {
  leads_to("/nowhere/file");
  EXPECT_THROW(PseudoTerminal(io_, link_), std::runtime_error);
  EXPECT_EQ(fs::read_symlink(link_), "/nowhere/file");
}

TEST_F(TerminalLink, ThatSomebodyElseHasPutInItsPlaceIsKept) {
  auto terminal = std::make_unique<PseudoTerminal>(io_, link_);
  fs::remove(link_);
  leads_to("/dev/null");
  terminal.reset();
  EXPECT_EQ(fs::read_symlink(link_), "/dev/null");
}

}  // namespace
}  // namespace interpolated_motion::transport
