#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace ridgeloc::results {

/// SHA-256 (FIPS 180-4) of bytes that arrive in pieces.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void update(std::span<const std::byte> bytes);
  void update(std::string_view text);
  /// The digest as 64 hexadecimal digits. Ends the computation: the object cannot be updated afterwards.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string sha256_hex(std::span<const std::byte> bytes);
std::string sha256_hex(std::string_view text);

/// SHA-256 in base64 (RFC 4648), as content security policies have it.
std::string sha256_base64(std::string_view text);

/// 64-bit fingerprint (XXH3 with seed 0) of bytes that arrive in pieces: fast enough for every column of
/// every block.
class Digest64 {
 public:
  Digest64();
  ~Digest64();
  Digest64(Digest64&&) noexcept;
  Digest64& operator=(Digest64&&) noexcept;

  void update(std::span<const std::byte> bytes);
  void update(std::uint64_t number);
  std::uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ridgeloc::results
