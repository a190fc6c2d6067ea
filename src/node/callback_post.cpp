#include "interpolated_motion_driver/node/callback_post.h"

#include <utility>

#include <boost/make_shared.hpp>

namespace interpolated_motion::node {
namespace {

class FunctionCallback : public ros::CallbackInterface {
 public:
  explicit FunctionCallback(std::function<void()> function) : function_(std::move(function)) {}

  CallResult call() override {
    function_();
    return Success;
  }

 private:
  std::function<void()> function_;
};

}  // namespace

void post_to(ros::CallbackQueueInterface& queue, std::function<void()> function) {
  queue.addCallback(boost::make_shared<FunctionCallback>(std::move(function)));
}

}  // namespace interpolated_motion::node
