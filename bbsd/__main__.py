"""`python -m bbsd` is `bbsd`."""

from bbsd.cli import main

if __name__ == "__main__":
    main()
