#include "results/util/digest.hpp"

#include <span>
#include <string>

#include "tests/support/catch.hpp"

using namespace ridgeloc::results;

TEST_CASE("SHA-256 gives the published digests") {
  // FIPS 180-4 examples.
  CHECK(sha256_hex("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256_hex("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  Sha256 pieces;
  pieces.update("a");
  pieces.update("bc");
  CHECK(pieces.hex() == sha256_hex("abc"));
}

TEST_CASE("the 64-bit fingerprint is XXH3 and does not depend on how bytes are cut") {
  CHECK(Digest64().value() == 0x2d06800538d394c2u);  // XXH3_64bits of no bytes, seed 0: published test vector
  const std::string text(1000, 'x');
  const auto bytes = std::as_bytes(std::span(text));
  Digest64 whole, cut;
  whole.update(bytes);
  cut.update(bytes.first(333));
  cut.update(bytes.subspan(333));
  CHECK(whole.value() == cut.value());
  cut.update(bytes.first(1));
  CHECK(whole.value() != cut.value());
}
