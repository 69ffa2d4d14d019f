#pragma once
/// Memory for large arrays with random access.

#include <cstddef>
#include <new>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace render {

/// An allocator that requests pages of 2 MB for arrays that span many of them. Traversal of a large tree by incoherent
/// rays then causes fewer TLB misses than with pages of 4 KB. Smaller arrays, and other systems, use the default pages.
template <class T> struct HugePageAllocator {
  /// Type of the elements.
  using value_type = T;

  HugePageAllocator() = default;
  /// Conversion to another element type; allocators have no state.
  template <class U> HugePageAllocator(const HugePageAllocator<U>&) {}

  /// Memory for n elements.
  T* allocate(std::size_t n) {
    void* p = ::operator new(n * sizeof(T), alignment(n));
#if defined(__linux__)
    if (large(n)) madvise(p, n * sizeof(T) / page * page, MADV_HUGEPAGE); // only a hint; failure is harmless
#endif
    return static_cast<T*>(p);
  }
  /// Default-initializes: elements without initial values are not written, so the thread that fills them touches their
  /// pages first.
  template <class U> void construct(U* p) { ::new (static_cast<void*>(p)) U; }
  /// Constructs an element from arguments.
  template <class U, class... Args> void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
  /// Frees the memory of n elements.
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n)); }

  /// All allocators are equal.
  bool operator==(const HugePageAllocator&) const { return true; }

 private:
  static constexpr std::size_t page = std::size_t{1} << 21;
  static bool large(std::size_t n) { return n * sizeof(T) >= 16 * page; }
  static std::align_val_t alignment(std::size_t n) { return std::align_val_t(large(n) ? page : alignof(T)); }
};

} // namespace render
