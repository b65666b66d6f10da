#include "results/util/digest.hpp"

#include <openssl/evp.h>
#include <xxhash.h>
#ifdef RIDGELOC_XXHASH_DISPATCH
#include <xxh_x86dispatch.h>  // redirects the calls below to the widest registers of the machine
#endif

#include <array>
#include <new>
#include <stdexcept>

namespace ridgeloc::results {
namespace {

using RawDigest = std::array<unsigned char, 32>;

void require_crypto(int returned) {
  if (returned != 1) throw std::runtime_error("SHA-256 is not available in the installed OpenSSL");
}

}  // namespace

struct Sha256::State {
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> context{EVP_MD_CTX_new()};
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  require_crypto(EVP_DigestInit_ex(state_->context.get(), EVP_sha256(), nullptr));
}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::update(std::span<const std::byte> bytes) {
  require_crypto(EVP_DigestUpdate(state_->context.get(), bytes.data(), bytes.size()));
}

void Sha256::update(std::string_view text) {
  update(std::as_bytes(std::span(text)));
}

std::string Sha256::hex() {
  RawDigest raw{};
  unsigned int size = 0;
  require_crypto(EVP_DigestFinal_ex(state_->context.get(), raw.data(), &size));
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * raw.size());
  for (const unsigned char byte : raw) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

std::string sha256_hex(std::span<const std::byte> bytes) {
  Sha256 sha;
  sha.update(bytes);
  return sha.hex();
}

std::string sha256_hex(std::string_view text) {
  return sha256_hex(std::as_bytes(std::span(text)));
}

std::string sha256_base64(std::string_view text) {
  RawDigest raw{};
  unsigned int size = 0;
  require_crypto(EVP_Digest(text.data(), text.size(), raw.data(), &size, EVP_sha256(), nullptr));
  std::array<unsigned char, 4 * ((raw.size() + 2) / 3) + 1> encoded{};  // with the zero that the library adds
  const int length = EVP_EncodeBlock(encoded.data(), raw.data(), static_cast<int>(raw.size()));
  return {encoded.begin(), encoded.begin() + length};
}

struct Digest64::State {
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state{XXH3_createState()};
};

Digest64::Digest64() : state_(std::make_unique<State>()) {
  if (state_->state == nullptr) throw std::bad_alloc();
  XXH3_64bits_reset(state_->state.get());
}
Digest64::~Digest64() = default;
Digest64::Digest64(Digest64&&) noexcept = default;
Digest64& Digest64::operator=(Digest64&&) noexcept = default;

void Digest64::update(std::span<const std::byte> bytes) {
  if (!bytes.empty()) XXH3_64bits_update(state_->state.get(), bytes.data(), bytes.size());
}

void Digest64::update(std::uint64_t number) {
  update(std::as_bytes(std::span(&number, 1)));
}

std::uint64_t Digest64::value() const {
  return XXH3_64bits_digest(state_->state.get());
}

}  // namespace ridgeloc::results
