// Numbers read and printed as in C in this thread, whatever the program's locale is.
#pragma once

#include <locale.h>

namespace viaface {

class CLocale {
  public:
    CLocale() : plain_(newlocale(LC_ALL_MASK, "C", nullptr)), own_(uselocale(plain_)) {}
    ~CLocale() {
        uselocale(own_);
        freelocale(plain_);
    }
    CLocale(const CLocale&) = delete;
    CLocale& operator=(const CLocale&) = delete;

  private:
    locale_t plain_, own_;
};

}  // namespace viaface
