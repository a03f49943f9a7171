"""The paper's loop on an arm through CRTK, and an arm to try it on. Nothing in here decides: `palpate serve` does."""
