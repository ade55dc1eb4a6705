"""The register budget: what the errors of the parts cost at the output while it dwells.

Begin with `budget`; `gains` is the linear map, `chain` the drive with its errors solved exactly.
"""
