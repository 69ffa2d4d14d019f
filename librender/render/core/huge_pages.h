#pragma once
/// Memory for large arrays that are read at random places.

#include <cstddef>
#include <new>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace render {

/// An allocator that asks for pages of 2 MB where an array fills many of them: rays at random find less of a tree of
/// 100 MB in the processor's table of pages of 4 KB. Elsewhere, and for smaller ones, as usual.
template <class T> struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <class U> HugePageAllocator(const HugePageAllocator<U>&) {}

  T* allocate(std::size_t n) {
    void* p = ::operator new(n * sizeof(T), alignment(n));
#if defined(__linux__)
    if (large(n)) madvise(p, n * sizeof(T) / page * page, MADV_HUGEPAGE); // advice: what it answers does not matter
#endif
    return static_cast<T*>(p);
  }
  /// Of what has no value to begin with, none is written: whoever fills an array touches its pages first.
  template <class U> void construct(U* p) { ::new (static_cast<void*>(p)) U; }
  template <class U, class... Args> void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n)); }

  bool operator==(const HugePageAllocator&) const { return true; }

 private:
  static constexpr std::size_t page = std::size_t{1} << 21;
  static bool large(std::size_t n) { return n * sizeof(T) >= 16 * page; }
  static std::align_val_t alignment(std::size_t n) { return std::align_val_t(large(n) ? page : alignof(T)); }
};

} // namespace render
