// The report's page, from the files in report/: cmake/ReportPage.cmake makes the definitions.
#pragma once

namespace quell {

extern const char* const kReportPage;        // HTML with marks for what a report fills in
extern const char* const kReportStyle;       // CSS
extern const char* const kReportScript;      // all modules as one
extern const char* const kReportStyleHash;   // SHA-256 as hexadecimal digits
extern const char* const kReportScriptHash;  // likewise

}  // namespace quell
