#include "common/site/certificate.hpp"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <array>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace longreach {
namespace {

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* p) const {
    Free(p);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using X509Cert = std::unique_ptr<X509, Freed<X509_free>>;
using Bio = std::unique_ptr<BIO, Freed<BIO_free_all>>;
using X509Request = std::unique_ptr<X509_REQ, Freed<X509_REQ_free>>;
using Store = std::unique_ptr<X509_STORE, Freed<X509_STORE_free>>;
using StoreContext = std::unique_ptr<X509_STORE_CTX, Freed<X509_STORE_CTX_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>>;

void require(bool done) {
  if (done) return;
  std::array<char, 256> text{};
  ERR_error_string_n(ERR_get_error(), text.data(), text.size());
  throw std::runtime_error(std::string("cannot create or read certificates: ") + text.data());
}

std::string text_of(BIO* bio) {
  char* at = nullptr;
  const long size = BIO_get_mem_data(bio, &at);
  return {at, static_cast<std::size_t>(size)};
}

Bio memory() {
  Bio bio(BIO_new(BIO_s_mem()));
  require(bio != nullptr);
  return bio;
}

X509Cert read_certificate(const std::string& pem) {
  const Bio bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  X509Cert out(PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr));
  require(out != nullptr);
  return out;
}

Key read_key(const std::string& pem) {
  const Bio bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  Key out(PEM_read_bio_PrivateKey(bio.get(), nullptr, nullptr, nullptr));
  require(out != nullptr);
  return out;
}

void add_extension(X509* certificate, X509* issuer, int nid, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, nid, value.c_str()));
  require(extension != nullptr && X509_add_ext(certificate, extension.get(), -1) == 1);
}

void set_serial(X509* certificate) {
  std::array<unsigned char, 16> bytes{};
  require(RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) == 1);
  bytes[0] = static_cast<unsigned char>((bytes[0] & 0x7F) | 0x40);  // positive, and of full length
  BIGNUM* number = BN_bin2bn(bytes.data(), static_cast<int>(bytes.size()), nullptr);
  const bool done =
      number != nullptr && BN_to_ASN1_INTEGER(number, X509_get_serialNumber(certificate)) != nullptr;
  BN_free(number);
  require(done);
}

/// Everything but extensions and signature.
X509Cert begin(const CertificateTerms& terms, EVP_PKEY* key) {
  X509Cert out(X509_new());
  require(out != nullptr && X509_set_version(out.get(), 2) == 1);  // 2 stands for version 3
  set_serial(out.get());
  require(ASN1_TIME_set_string_X509(X509_getm_notBefore(out.get()), terms.not_before.c_str()) == 1);
  require(ASN1_TIME_set_string_X509(X509_getm_notAfter(out.get()), terms.not_after.c_str()) == 1);
  require(X509_set_pubkey(out.get(), key) == 1);
  X509_NAME* name = X509_get_subject_name(out.get());
  require(X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8,
                                     reinterpret_cast<const unsigned char*>(terms.name.c_str()), -1, -1,
                                     0) == 1);
  return out;
}

Key make_key() {
  Key key(EVP_EC_gen("P-256"));
  require(key != nullptr);
  return key;
}

const char* usage_of(CertificateUse use) {
  switch (use) {
    case CertificateUse::kServer:
      return "serverAuth";
    case CertificateUse::kClient:
      return "clientAuth";
    case CertificateUse::kBoth:
      break;
  }
  return "serverAuth,clientAuth";
}

std::string pem_text(X509* certificate) {
  const Bio text = memory();
  require(PEM_write_bio_X509(text.get(), certificate) == 1);
  return text_of(text.get());
}

std::string key_text(EVP_PKEY* key) {
  const Bio text = memory();
  require(PEM_write_bio_PrivateKey(text.get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1);
  return text_of(text.get());
}

std::string sign(const Certificate& authority, EVP_PKEY* key, const CertificateTerms& terms) {
  const X509Cert issuer = read_certificate(authority.certificate_pem);
  const Key issuer_key = read_key(authority.key_pem);
  const X509Cert out = begin(terms, key);
  require(X509_set_issuer_name(out.get(), X509_get_subject_name(issuer.get())) == 1);
  add_extension(out.get(), issuer.get(), NID_basic_constraints, "critical,CA:FALSE");
  add_extension(out.get(), issuer.get(), NID_key_usage, "critical,digitalSignature");
  add_extension(out.get(), issuer.get(), NID_ext_key_usage, usage_of(terms.use));
  add_extension(out.get(), issuer.get(), NID_subject_alt_name, "DNS:" + terms.name);
  add_extension(out.get(), issuer.get(), NID_subject_key_identifier, "hash");
  add_extension(out.get(), issuer.get(), NID_authority_key_identifier, "keyid");
  require(X509_sign(out.get(), issuer_key.get(), EVP_sha256()) != 0);
  return pem_text(out.get());
}

template <class Read>
bool can_be_read(const Read& read) {
  try {
    read();
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace

Certificate make_authority(const std::string& name) {
  const Key key = make_key();
  const X509Cert out = begin({.name = name}, key.get());
  require(X509_set_issuer_name(out.get(), X509_get_subject_name(out.get())) == 1);
  add_extension(out.get(), out.get(), NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
  add_extension(out.get(), out.get(), NID_key_usage, "critical,keyCertSign,cRLSign");
  add_extension(out.get(), out.get(), NID_subject_key_identifier, "hash");
  require(X509_sign(out.get(), key.get(), EVP_sha256()) != 0);
  return {pem_text(out.get()), key_text(key.get())};
}

Certificate issue(const Certificate& authority, const CertificateTerms& terms) {
  const Key key = make_key();
  return {sign(authority, key.get(), terms), key_text(key.get())};
}

CertificateRequest make_request() {
  const Key key = make_key();
  const X509Request request(X509_REQ_new());
  require(request != nullptr && X509_REQ_set_pubkey(request.get(), key.get()) == 1);
  require(X509_REQ_sign(request.get(), key.get(), EVP_sha256()) != 0);
  const Bio text = memory();
  require(PEM_write_bio_X509_REQ(text.get(), request.get()) == 1);
  return {text_of(text.get()), key_text(key.get())};
}

std::string certify(const Certificate& authority, const std::string& request_pem,
                    const CertificateTerms& terms) {
  const Bio text(BIO_new_mem_buf(request_pem.data(), static_cast<int>(request_pem.size())));
  const X509Request request(PEM_read_bio_X509_REQ(text.get(), nullptr, nullptr, nullptr));
  require(request != nullptr);
  EVP_PKEY* key = X509_REQ_get0_pubkey(request.get());
  std::array<char, 32> group{};
  const bool ours = key != nullptr && EVP_PKEY_is_a(key, "EC") == 1 &&
                    EVP_PKEY_get_group_name(key, group.data(), group.size(), nullptr) == 1 &&
                    std::string_view(group.data()) == "prime256v1";
  require(ours && X509_REQ_verify(request.get(), key) == 1);
  return sign(authority, key, terms);
}

bool is_certificate(const std::string& certificate_pem) {
  return can_be_read([&] { (void)read_certificate(certificate_pem); });
}

bool is_key(const std::string& key_pem) {
  return can_be_read([&] { (void)read_key(key_pem); });
}

bool belong_together(const Certificate& certificate) {
  return X509_check_private_key(read_certificate(certificate.certificate_pem).get(),
                                read_key(certificate.key_pem).get()) == 1;
}

std::string fingerprint(const std::string& certificate_pem) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned size = 0;
  require(X509_digest(read_certificate(certificate_pem).get(), EVP_sha256(), bytes.data(), &size) == 1);
  std::string out = "SHA256:";
  for (unsigned i = 0; i < size; ++i) {
    constexpr std::string_view kHex = "0123456789abcdef";
    out += kHex[bytes[i] >> 4U];
    out += kHex[bytes[i] & 15U];
  }
  return out;
}

std::string valid_until(const std::string& certificate_pem) {
  std::tm time{};
  require(ASN1_TIME_to_tm(X509_get0_notAfter(read_certificate(certificate_pem).get()), &time) == 1);
  std::array<char, 16> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d", &time)};
}

std::string certificate_trouble(const std::string& authority_pem, const std::string& certificate_pem,
                                const std::string& key_pem, const std::string& name) {
  try {
    const X509Cert authority = read_certificate(authority_pem),
                   certificate = read_certificate(certificate_pem);
    if (!key_pem.empty() && !is_key(key_pem)) return "its key cannot be read";
    if (!key_pem.empty() && !belong_together({certificate_pem, key_pem})) return "it does not match its key";
    const Store store(X509_STORE_new());
    const StoreContext context(X509_STORE_CTX_new());
    require(store != nullptr && context != nullptr &&
            X509_STORE_add_cert(store.get(), authority.get()) == 1 &&
            X509_STORE_CTX_init(context.get(), store.get(), certificate.get(), nullptr) == 1);
    if (X509_verify_cert(context.get()) != 1)
      return std::string("it is not valid for this site: ") +
             X509_verify_cert_error_string(X509_STORE_CTX_get_error(context.get()));
    if (!name.empty() && X509_check_host(certificate.get(), name.data(), name.size(), 0, nullptr) != 1)
      return "it was not issued to " + name;
    return "";
  } catch (const std::runtime_error&) {
    return "it cannot be read";
  }
}

}  // namespace longreach
