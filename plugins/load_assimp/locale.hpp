// Numbers in files have a decimal point, whatever the user's language writes.
#pragma once

#include <locale.h>

namespace foam::load_assimp {

/// The calling thread has the C locale as long as it lives.
class ScopedCLocale {
public:
    ScopedCLocale() : c_(newlocale(LC_ALL_MASK, "C", nullptr)), before_(uselocale(c_)) {}
    ~ScopedCLocale() {
        uselocale(before_);
        freelocale(c_);
    }
    ScopedCLocale(const ScopedCLocale&) = delete;
    ScopedCLocale& operator=(const ScopedCLocale&) = delete;

private:
    locale_t c_, before_;
};

} // namespace foam::load_assimp
