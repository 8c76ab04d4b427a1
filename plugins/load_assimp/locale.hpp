// Numbers in files have a decimal point, whatever the user's locale.
#pragma once

#include <locale.h>

namespace foam::load_assimp {

/// Sets the C locale for the calling thread during its lifetime.
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
