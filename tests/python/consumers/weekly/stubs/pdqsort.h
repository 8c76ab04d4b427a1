// In place of pdqsort, which VAMP's headers include and no package has.
#pragma once
#include <algorithm>

template <class Iterator, class Compare>
void pdqsort_branchless(Iterator begin, Iterator end, Compare compare) {
    std::sort(begin, end, compare);
}
