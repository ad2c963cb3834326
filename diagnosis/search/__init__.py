"""The search: effects screened, fitted together, compared."""
