#pragma once

#include <mpfr.h>

namespace algebra3d {

/// An owning MPFR number. At the end of a thread its MPFR constants are freed, too.
class MpfrFloat {
 public:
  explicit MpfrFloat(mpfr_prec_t bits) {
    static thread_local const ConstantsOfThread constants;
    mpfr_init2(value_, bits);
  }
  MpfrFloat(const MpfrFloat&) = delete;
  MpfrFloat(MpfrFloat&&) = delete;
  MpfrFloat& operator=(const MpfrFloat&) = delete;
  MpfrFloat& operator=(MpfrFloat&&) = delete;
  ~MpfrFloat() { mpfr_clear(value_); }

  mpfr_ptr get() { return value_; }

 private:
  struct ConstantsOfThread {
    ConstantsOfThread() = default;
    ConstantsOfThread(const ConstantsOfThread&) = delete;
    ConstantsOfThread(ConstantsOfThread&&) = delete;
    ConstantsOfThread& operator=(const ConstantsOfThread&) = delete;
    ConstantsOfThread& operator=(ConstantsOfThread&&) = delete;
    ~ConstantsOfThread() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
  };

  mpfr_t value_;
};

}  // namespace algebra3d
