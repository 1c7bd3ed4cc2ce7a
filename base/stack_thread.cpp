#include "base/stack_thread.h"

#include <cfenv>
#include <utility>

namespace algebra3d {
namespace {

/// Attributes of a thread with that stack.
class Attributes {
 public:
  Attributes() {
    pthread_attr_init(&attributes_);
    pthread_attr_setstacksize(&attributes_, StackThread::kStackBytes);
  }
  ~Attributes() { pthread_attr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const pthread_attr_t* get() const { return &attributes_; }

 private:
  pthread_attr_t attributes_;
};

// A thread begins with the rounding mode of the one that starts it.
void* run_work(void* work) {
  std::fesetround(FE_TONEAREST);
  (*static_cast<std::function<void()>*>(work))();
  return nullptr;
}

}  // namespace

bool StackThread::start(std::function<void()> work) {
  work_ = std::move(work);
  is_running_ = pthread_create(&thread_, Attributes().get(), run_work, &work_) == 0;
  return is_running_;
}

void StackThread::join() {
  if (std::exchange(is_running_, false)) pthread_join(thread_, nullptr);
}

void StackThread::make_default() {
  pthread_setattr_default_np(Attributes().get());
}

}  // namespace algebra3d
