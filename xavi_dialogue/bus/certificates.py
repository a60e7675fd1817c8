"""Certificates of the bus: the only module that imports cryptography.

Keys are on the curve P-256; certificates are X.509, as TLS libraries check them (RFC 5280).

    CertificateError
    ├── BadHost          a host name that a certificate cannot contain
    └── BadCertificate   a certificate that cannot be read
"""

import ipaddress
import re
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Self

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from xavi_dialogue.bus.errors import BusError

AUTHORITY = "xavi development CA"
SKEW = timedelta(minutes=5)  # greatest delay of other clocks
HOST = re.compile(r"(?!-)[A-Za-z0-9-]{1,63}(?<!-)(\.(?!-)[A-Za-z0-9-]{1,63}(?<!-))*")
MAX_HOST = 253  # characters of a name in the DNS


class CertificateError(BusError, ValueError):
    """A certificate that cannot be made or used."""


class BadHost(CertificateError):
    """A host name that a certificate cannot contain."""


class BadCertificate(CertificateError):
    """A certificate that cannot be read."""


@dataclass(frozen=True, slots=True)
class Identity:
    """A certificate and its private key, both PEM."""

    certificate: bytes
    key: bytes


@dataclass(frozen=True, slots=True)
class CertificateInfo:
    """The contents of a certificate."""

    name: str  # common name
    issuer: str  # common name
    begins: datetime  # UTC
    ends: datetime  # UTC


@dataclass(frozen=True, slots=True)
class Authority:
    """A development CA. It signs certificates that are valid no longer than its own."""

    certificate: x509.Certificate
    key: ec.EllipticCurvePrivateKey

    @classmethod
    def new(cls, now: datetime, valid: timedelta) -> Self:
        """Return a new authority.

        Args:
            now: start of its validity, less SKEW; with a time zone.
            valid: duration of its validity.
        """
        key = ec.generate_private_key(ec.SECP256R1())
        draft = _draft(AUTHORITY, AUTHORITY, key, (now - SKEW, now + valid))
        draft = draft.add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
        draft = draft.add_extension(_usage(signs_certificates=True), critical=True)
        return cls(draft.sign(key, hashes.SHA256()), key)

    @classmethod
    def load(cls, identity: Identity) -> Self:
        """Load an authority that was made before.

        Raises:
            BadCertificate: it cannot be read, or was not made by this program.
        """
        try:
            certificate = x509.load_pem_x509_certificate(identity.certificate)
            key = serialization.load_pem_private_key(identity.key, password=None)
        except (ValueError, TypeError) as error:
            raise BadCertificate(f"not a certificate with its key: {error}") from error
        if not isinstance(key, ec.EllipticCurvePrivateKey):
            raise BadCertificate("the key is not of the kind used here; run `xavi keys` again")
        if key.public_key() != certificate.public_key():
            raise BadCertificate("the key does not belong to the certificate")
        return cls(certificate, key)

    @property
    def identity(self) -> Identity:
        """Its certificate and key in PEM, for storage."""
        return _identity(self.certificate, self.key)

    def issue(
        self, name: str, hosts: Sequence[str], now: datetime, valid: timedelta | None = None
    ) -> Identity:
        """Make a key and a certificate for it.

        Args:
            name: common name, by which access is granted.
            hosts: names and addresses of a hub. Without any, the certificate is for a client,
                and no client accepts it as that of a hub.
            now: start of its validity, less SKEW; with a time zone.
            valid: duration of its validity, which ends with that of the authority at the latest;
                None: it ends then.

        Raises:
            BadHost: one of the hosts is neither a name nor an address.
        """
        key = ec.generate_private_key(ec.SECP256R1())
        ends = self.certificate.not_valid_after_utc
        if valid is not None:
            ends = min(ends, now + valid)
        begins = min(now - SKEW, ends)
        draft = _draft(name, AUTHORITY, key, (begins, ends))
        draft = draft.add_extension(x509.BasicConstraints(ca=False, path_length=None), True)
        draft = draft.add_extension(_usage(signs_certificates=False), critical=True)
        purposes = [ExtendedKeyUsageOID.CLIENT_AUTH]
        if hosts:
            purposes.append(ExtendedKeyUsageOID.SERVER_AUTH)
            known = x509.SubjectAlternativeName([_host(host) for host in hosts])
            draft = draft.add_extension(known, critical=False)
        draft = draft.add_extension(x509.ExtendedKeyUsage(purposes), critical=False)
        ours = x509.AuthorityKeyIdentifier.from_issuer_public_key(self.key.public_key())
        draft = draft.add_extension(ours, critical=False)
        return _identity(draft.sign(self.key, hashes.SHA256()), key)


def read(certificate: bytes) -> CertificateInfo:
    """Read the contents of a certificate.

    Args:
        certificate: PEM.

    Raises:
        BadCertificate: it cannot be read.
    """
    try:
        found = x509.load_pem_x509_certificate(certificate)
    except ValueError as error:
        raise BadCertificate(f"no certificate: {error}") from error
    name, issuer = _common_name(found.subject), _common_name(found.issuer)
    return CertificateInfo(name, issuer, found.not_valid_before_utc, found.not_valid_after_utc)


def utc_now() -> datetime:
    """Return the current time, in UTC."""
    return datetime.now(UTC)


def _draft(
    name: str,
    issuer: str,
    key: ec.EllipticCurvePrivateKey,
    valid: tuple[datetime, datetime],
) -> x509.CertificateBuilder:
    identifier = x509.SubjectKeyIdentifier.from_public_key(key.public_key())
    return (
        x509.CertificateBuilder()
        .subject_name(_named(name))
        .issuer_name(_named(issuer))
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(valid[0])
        .not_valid_after(valid[1])
        .add_extension(identifier, critical=False)
    )


def _common_name(name: x509.Name) -> str:
    names = name.get_attributes_for_oid(NameOID.COMMON_NAME)
    return str(names[0].value) if names else ""


def _named(name: str) -> x509.Name:
    return x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)])


def _usage(*, signs_certificates: bool) -> x509.KeyUsage:
    return x509.KeyUsage(
        digital_signature=not signs_certificates,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        key_cert_sign=signs_certificates,
        crl_sign=signs_certificates,
        encipher_only=False,
        decipher_only=False,
    )


def _host(host: str) -> x509.GeneralName:
    try:
        return x509.IPAddress(ipaddress.ip_address(host))
    except ValueError:
        if len(host) > MAX_HOST or not HOST.fullmatch(host):
            raise BadHost(f"{host!r} is neither the name of a host nor an address") from None
        return x509.DNSName(host)


def _identity(certificate: x509.Certificate, key: ec.EllipticCurvePrivateKey) -> Identity:
    return Identity(
        certificate.public_bytes(serialization.Encoding.PEM),
        key.private_bytes(
            serialization.Encoding.PEM,
            serialization.PrivateFormat.PKCS8,
            serialization.NoEncryption(),
        ),
    )
