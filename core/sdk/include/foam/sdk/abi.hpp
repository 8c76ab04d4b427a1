// The fingerprint of a build. Two binaries may exchange C++ objects only if their fingerprints are equal.
#pragma once

#include <foam/sdk/abi_record.hpp> // FOAM_ABI_LAYOUT: made with the build from core/abi

#include <cstdint>
#include <string> // defines the library macros

/// The ABI epoch. It is raised whenever the layout or meaning of a public type changes. Within an unreleased epoch,
/// FOAM_ABI_LAYOUT tells its states apart. Reasons:
///  1  spheres alone: commits before the first release
///  2  first release: an approximation holds elements of any kind, and primitives of a robot are elements
#define FOAM_ABI_EPOCH 2

#define FOAM_ABI_TEXT_(x) #x
#define FOAM_ABI_TEXT(x) FOAM_ABI_TEXT_(x)

#if defined(_GLIBCXX_RELEASE)
#define FOAM_ABI_STDLIB "libstdc++"
#define FOAM_ABI_CXX11 FOAM_ABI_TEXT(_GLIBCXX_USE_CXX11_ABI)
#else
#define FOAM_ABI_STDLIB "libc++"
#define FOAM_ABI_CXX11 "-"
#endif

#if defined(__SANITIZE_ADDRESS__)
#define FOAM_ABI_SANITIZER "address"
#elif defined(__SANITIZE_THREAD__)
#define FOAM_ABI_SANITIZER "thread"
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FOAM_ABI_SANITIZER "address"
#elif __has_feature(thread_sanitizer)
#define FOAM_ABI_SANITIZER "thread"
#endif
#endif
#ifndef FOAM_ABI_SANITIZER
#define FOAM_ABI_SANITIZER "none"
#endif

#ifdef _GLIBCXX_DEBUG
#define FOAM_ABI_DEBUG " debug-containers"
#else
#define FOAM_ABI_DEBUG ""
#endif

#define FOAM_ABI_FINGERPRINT                                                                                           \
    "foam-abi=" FOAM_ABI_TEXT(FOAM_ABI_EPOCH) " layout=" FOAM_ABI_LAYOUT " stdlib=" FOAM_ABI_STDLIB FOAM_ABI_DEBUG     \
                                              " cxx11=" FOAM_ABI_CXX11 " sanitizer=" FOAM_ABI_SANITIZER

/// Defines an ELF note (name "foam", type 1) whose description is the fingerprint, readable without loading the
/// library.
#define FOAM_ABI_NOTE                                                                                                  \
    __attribute__((section(".note.foam"), used, aligned(4))) static const struct {                                     \
        std::uint32_t name_size, description_size, type;                                                               \
        char name[8];                                                                                                  \
        char description[(sizeof(FOAM_ABI_FINGERPRINT) + 3) / 4 * 4];                                                  \
    } foam_abi_note = {5, sizeof(FOAM_ABI_FINGERPRINT), 1, "foam", FOAM_ABI_FINGERPRINT};
