// Included before all else: binds a function to the version of it that the libstdc++ of g++ 11 has, too (PEP 600's
// manylinux_2_34). Its newer version is the same but for `noexcept`.
__asm__(".symver _ZNSt18condition_variable4waitERSt11unique_lockISt5mutexE,"
        "_ZNSt18condition_variable4waitERSt11unique_lockISt5mutexE@GLIBCXX_3.4.11");
